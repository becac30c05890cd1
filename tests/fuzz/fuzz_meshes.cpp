// The mesh readers of ours: STL, PLY, OBJ, OFF, glTF and GLB. The input is a mesh file; its first
// bytes choose the reader, as no ending does. A reader may only return a valid mesh or throw an
// Error.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "mesh/mesh_readers.hpp"

using namespace vantage;

namespace {

void read_by_content(std::span<const std::uint8_t> bytes, raycore::detail::MeshBuilder& mesh) {
  using namespace raycore::detail;
  const std::string_view text = as_text(bytes);
  if (text.starts_with("ply")) return read_ply(bytes, mesh);
  if (text.starts_with("glTF") || text.starts_with("{")) {
    return read_gltf(bytes, "/nowhere/fuzz.gltf", mesh);
  }
  if (text.substr(0, 8).find("OFF") != std::string_view::npos) return read_off(bytes, mesh);
  if (text.starts_with("v ") || text.starts_with("#")) return read_obj(bytes, mesh);
  read_stl(bytes, mesh);
}

void check(const TriangleMesh& mesh) {
  if (mesh.empty()) std::abort();
  for (const Eigen::Vector3f& p : mesh.vertices()) {
    if (!p.allFinite()) std::abort();
  }
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t index : triangle) {
      if (index >= mesh.vertices().size()) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  raycore::detail::MeshBuilder collector("fuzz", 0.001);
  try {
    read_by_content({data, size}, collector);
    check(std::move(collector).finish());
  } catch (const Error& error) {
    if (error.where().empty() || error.message().empty()) std::abort();
  }
  return 0;
}
