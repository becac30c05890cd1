#include "vantage/raycore/mesh_io.hpp"

#include <fmt/format.h>

#include "core/byte_order.hpp"
#include "vantage/raycore/file.hpp"

namespace vantage {

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment vantage, metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.vertices().size(), mesh.triangles().size());
  bytes.reserve(bytes.size() + 12 * mesh.vertices().size() + 13 * mesh.triangles().size());
  for (const Eigen::Vector3f& p : mesh.vertices()) {
    for (const float coordinate : p) detail::append_little_endian(bytes, coordinate);
  }
  for (const Triangle& triangle : mesh.triangles()) {
    bytes.push_back(3);
    for (const std::uint32_t index : triangle) detail::append_little_endian(bytes, index);
  }
  write_file(path, bytes);
}

}  // namespace vantage
