#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/detail/limits.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// The whole file.
/// @throws Error bad_input if it is missing, not a regular file, cannot be read, is larger than
/// `max_bytes`, or is a Git LFS pointer.
VANTAGE_API std::vector<std::uint8_t> read_file(const std::filesystem::path& path,
                                                std::size_t max_bytes = limits::kMaxFileBytes);

/// Writes `bytes` beside `path`, has the disk keep them, and renames: the file is there whole, or
/// as it was before, whatever happens to the process or the machine. Many may write the same path
/// at once; the last one wins.
/// @throws Error bad_input if the folder is missing or cannot be written, or if `path` is a folder
/// or a device; out_of_resources if the disk is full.
VANTAGE_API void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The same for a writer that wants a path: `write` gets the temporary file's, which has the same
/// ending as `path`. What `write` throws is passed on, and the temporary is removed.
VANTAGE_API void write_file_with(const std::filesystem::path& path,
                                 const std::function<void(const std::filesystem::path&)>& write);

/// Removes the temporary files that processes which were killed left in a folder; those of running
/// ones stay. What cannot be removed, or looked at, stays without a word.
VANTAGE_API void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace vantage
