#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace vantage::raycore::detail {

/// The bytes of a file that a mesh names. A mesh comes from anywhere: it may name what lies in its
/// own folder or below, as a regular file, and nothing else on this machine.
/// @param mesh  the path of the mesh.
/// @param name  relative to the mesh's folder, UTF-8.
/// @throws Error bad_input, at the mesh, for a path that leads out of the folder (also by a
/// symbolic link), a file that is not there, a folder, a pipe or a device.
std::vector<std::uint8_t> read_file_beside(const std::filesystem::path& mesh,
                                           std::string_view name);

}  // namespace vantage::raycore::detail
