#include "mesh/gltf/file_beside.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/text_scanner.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {

std::vector<std::uint8_t> read_file_beside(const std::filesystem::path& mesh,
                                           std::string_view name) {
  namespace fs = std::filesystem;
  const auto refuse = [&](std::string_view why) {
    throw bad_input(
        mesh.string(),
        fmt::format("names the file {}, which {}; expected a regular file in the mesh's "
                    "folder or below it",
                    in_quotes(name), why));
  };
  if (name.empty() || name.find('\0') != std::string_view::npos) refuse("is not a path");
  if (fs::path(name).is_absolute()) refuse("is an absolute path");
  std::error_code error;
  const fs::path folder = fs::canonical(mesh.has_parent_path() ? mesh.parent_path() : ".", error);
  if (error) refuse("cannot be found: " + error.message());
  // Symbolic links are followed here, so that they cannot lead out.
  const fs::path file = fs::canonical(folder / fs::path(name), error);
  if (error) refuse("cannot be found: " + error.message());
  const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  if (end != folder.end()) refuse("leads out of the mesh's folder");
  if (!fs::is_regular_file(file, error)) refuse("is not a regular file");
  return read_file(file);
}

}  // namespace vantage::raycore::detail
