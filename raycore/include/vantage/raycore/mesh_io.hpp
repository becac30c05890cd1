#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// The axis of a mesh file's frame that points up, away from the floor.
enum class UpAxis { x, y, z, minus_x, minus_y, minus_z };

/// How the coordinates of a mesh file become metres in a frame whose z axis points up.
struct MeshFileFrame {
  double unit_m = 1.0;            ///< what one unit of the file is in metres (BOP's models: 0.001)
  std::optional<UpAxis> up = {};  ///< none: what the file or its format says, below
};

/// Reads a mesh by its file's ending: STL, PLY, OBJ, OFF, glTF 2.0 and GLB by readers of ours,
/// which check every count against the file's size; DAE, FBX, 3DS and 3MF through assimp in a
/// process of its own with limits of time (2 s of computing and 2 s more for each MiB of the file)
/// and memory (768 MiB), so that a damaged file cannot take this one down. Other formats are
/// refused by name. Polygons, also concave ones, are cut into triangles; normals, colours,
/// materials, skins and morph targets are left.
///
/// Up: STL, PLY, OBJ, OFF, 3DS and 3MF keep their coordinates (z is up). glTF is y-up by its
/// standard and is stood upright: (x, y, z) becomes (x, -z, y). A DAE says it itself (up_axis,
/// y if it says nothing), and an FBX. `frame.up` overrides what the file says.
///
/// Unit: coordinates are multiplied by `unit_m`. Those of a DAE are in metres before that, by its
/// unit element; no other format's own unit is used.
///
/// Files that a mesh names (a .gltf's buffers) are read only if they are regular files in the
/// mesh's folder or below it. What is odd but harmless is in the mesh's `remarks`. May be called
/// from any thread; a file for assimp forks the calling process.
/// @throws Error bad_input with the place in the file if it is damaged, has no triangles, or claims
/// more than it holds: "part.obj:12" is a line, counted from 1; "part.ply, vertex 12" an element,
/// counted from 0. out_of_resources if memory or the stated limit of it runs out.
VANTAGE_API TriangleMesh read_mesh(const std::filesystem::path& path, const MeshFileFrame& frame);
VANTAGE_API TriangleMesh read_mesh(const std::filesystem::path& path, double unit_m = 1.0);

/// Binary little-endian PLY, metres. The same mesh gives the same bytes.
VANTAGE_API void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh);

/// A mesh with a name and a colour, for viewers.
struct ColoredMesh {
  std::string name;
  TriangleMesh mesh;
  Eigen::Vector3f color = {0.8f, 0.8f, 0.8f};  ///< sRGB, 0 to 1
  float opacity = 1;
};

/// glTF 2.0 binary (.glb), one node per mesh, flat shaded. World z up becomes glTF's y up in the
/// root node. The same meshes give the same bytes. Meshes without triangles are left out.
/// @throws Error as `write_file` does; bad_input for a colour or opacity outside 0 to 1;
/// out_of_resources for more triangles than the format's 4 GiB hold.
VANTAGE_API void write_glb(const std::filesystem::path& path,
                           const std::vector<ColoredMesh>& meshes);

}  // namespace vantage
