#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count_type;  ///< set for a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// What a PLY file says of itself before its data.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view name) const;
};

/// Reads as far as the line "end_header"; `text` is then at the first byte of the data.
/// @throws Error bad_input with the line.
PlyHeader read_ply_header(TextScanner& text);

/// @throws Error bad_input at the file if `size` bytes of data cannot hold what the header claims.
void check_ply_counts(const PlyHeader& header, std::uint64_t size, const std::string& file);

}  // namespace vantage::raycore::detail
