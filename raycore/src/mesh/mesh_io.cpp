#include "vantage/raycore/mesh_io.hpp"

#include <fmt/format.h>
#include <cmath>
#include <new>

#include "core/byte_order.hpp"
#include "mesh/mesh_readers.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

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
  raycore::detail::MeshCollector mesh(path.string(), unit_m);
  const std::string ending = lower_cased_ending(path);
  if (ending == ".stl") {
    raycore::detail::read_stl(bytes, mesh);
  } else if (ending == ".ply") {
    raycore::detail::read_ply(bytes, mesh);
  } else if (ending == ".obj") {
    raycore::detail::read_obj(bytes, mesh);
  } else {
    raycore::detail::read_with_assimp(path, mesh);
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

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment vantage, metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.vertices().size(), mesh.triangles().size());
  bytes.reserve(bytes.size() + 12 * mesh.vertices().size() + 13 * mesh.triangles().size());
  for (const Eigen::Vector3f& p : mesh.vertices()) {
    for (const float coordinate : p) raycore::detail::append_little_endian(bytes, coordinate);
  }
  for (const Triangle& triangle : mesh.triangles()) {
    bytes.push_back(3);
    for (const std::uint32_t index : triangle) raycore::detail::append_little_endian(bytes, index);
  }
  write_file(path, bytes);
}

}  // namespace vantage
