#pragma once

#include <cstddef>
#include <cstdint>

/// How much is read at most: one budget for all that comes from files, checked by sizes and headers
/// before memory is taken. Beyond, it is an Error bad_input; exit code 3. What they come to stays
/// near 1 GiB for any one file. docs/formats.md lists them.
namespace vantage::limits {

inline constexpr std::size_t kMebibyte = std::size_t(1) << 20;

// Any file, and those of which there may be many or that unpack to more.
inline constexpr std::size_t kMaxFileBytes = 512 * kMebibyte;
inline constexpr std::size_t kMaxImageBytes = 256 * kMebibyte;
inline constexpr std::size_t kMaxJsonBytes = 64 * kMebibyte;
inline constexpr std::size_t kMaxYamlBytes = 16 * kMebibyte;

// YAML and JSON; lists and mappings count as values, aliases for all that they stand for.
inline constexpr std::size_t kMaxJsonValues = 2'000'000;
inline constexpr std::size_t kMaxYamlValues = 1'000'000;
inline constexpr int kMaxDocumentDepth = 64;
inline constexpr std::size_t kMaxKeyBytes = 1024;

// Images: a side, all of one, and the depths of all images of a scene, of four bytes each.
inline constexpr std::uint32_t kMaxImageSide = 16384;
inline constexpr std::uint64_t kMaxImagePixels = 64 * kMebibyte;
inline constexpr std::uint64_t kMaxScenePixels = 256 * kMebibyte;

}  // namespace vantage::limits
