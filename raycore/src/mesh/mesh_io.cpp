#include "vantage/raycore/mesh_io.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>

#include "mesh/mesh_readers.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/file.hpp"

namespace vantage {
namespace {

std::string lower_cased_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  }
  return ending;
}

TriangleMesh read(const std::filesystem::path& path, double unit_m) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  if (bytes.empty()) throw bad_input(path.string(), "is empty; expected a mesh");
  detail::MeshCollector mesh(path.string(), unit_m);
  const std::string ending = lower_cased_ending(path);
  if (ending == ".stl") {
    detail::read_stl(bytes, mesh);
  } else if (ending == ".ply") {
    detail::read_ply(bytes, mesh);
  } else if (ending == ".obj") {
    detail::read_obj(bytes, mesh);
  } else {
    detail::read_with_assimp(path, mesh);
  }
  return std::move(mesh).finish();
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, double unit_m) {
  if (!std::isfinite(unit_m) || unit_m <= 0) {
    throw bad_input("unit_m", fmt::format("is {}; expected the size of the file's unit in metres, "
                                          "a finite number above 0",
                                          unit_m));
  }
  try {
    return read(path, unit_m);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_resources, path.string(), "does not fit into memory");
  }
}

}  // namespace vantage
