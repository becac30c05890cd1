#include "vantage/raycore/mesh_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <stdexcept>

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

/// Formats that people ask for and that have no safe reader, by their names.
[[noreturn]] void refuse_format(const std::filesystem::path& path, const std::string& ending) {
  constexpr std::array<std::string_view, 6> kGeometry = {".step", ".stp",  ".iges",
                                                         ".igs",  ".brep", ".sldprt"};
  const bool geometry = std::ranges::find(kGeometry, ending) != kGeometry.end();
  throw bad_input(
      path.string(),
      fmt::format(
          "has the ending \"{}\"; expected a mesh: .stl, .ply, .obj, .off, .glb, .gltf (2.0), "
          ".dae, .fbx, .3ds or .3mf; {}",
          ending,
          geometry ? "this is CAD geometry, not a mesh: export it as STL from the CAD program"
                   : "convert it to one of these, for example with Blender or MeshLab"));
}

TriangleMesh read(const std::filesystem::path& path, const MeshFileFrame& frame) {
  using namespace raycore::detail;
  const std::string ending = lower_cased_ending(path);
  const bool for_assimp =
      ending == ".dae" || ending == ".fbx" || ending == ".3ds" || ending == ".3mf";
  const std::vector<std::uint8_t> bytes = read_file(path);
  if (bytes.empty()) throw bad_input(path.string(), "is empty; expected a mesh");
  MeshBuilder mesh(path.string(), frame);
  if (ending == ".stl") {
    read_stl(bytes, mesh);
  } else if (ending == ".ply") {
    read_ply(bytes, mesh);
  } else if (ending == ".obj") {
    read_obj(bytes, mesh);
  } else if (ending == ".off") {
    read_off(bytes, mesh);
  } else if (ending == ".glb" || ending == ".gltf") {
    read_gltf(bytes, path, mesh);
  } else if (for_assimp) {
    read_with_assimp(bytes, path, mesh);
  } else {
    refuse_format(path, ending);
  }
  return std::move(mesh).finish();
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, const MeshFileFrame& frame) {
  if (!std::isfinite(frame.unit_m) || frame.unit_m <= 0) {
    throw bad_input("unit_m", fmt::format("is {}; expected the size of the file's unit in metres, "
                                          "a finite number above 0",
                                          frame.unit_m));
  }
  try {
    return read(path, frame);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_resources, path.string(), "does not fit into memory");
  } catch (const std::length_error&) {
    throw Error(ErrorCode::out_of_resources, path.string(), "does not fit into memory");
  }
}

TriangleMesh read_mesh(const std::filesystem::path& path, double unit_m) {
  return read_mesh(path, MeshFileFrame{.unit_m = unit_m});
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
