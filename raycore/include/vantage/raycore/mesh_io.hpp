#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// Reads a mesh by its file's ending: STL (binary and ASCII), PLY (ASCII, binary of both byte
/// orders) and OBJ by readers of ours, which check every count against the file's size; any other
/// format through assimp. Polygons are split into fans; normals, colours and materials are left.
/// Axes stay as the file has them: no format's own "up" is turned to z.
/// @param unit_m what one unit of the file is in metres (BOP's models: 0.001).
/// @throws Error bad_input with the place in the file if it is damaged, has no triangles, or claims
/// more than it holds: "part.obj:12" is a line, counted from 1; "part.ply, vertex 12" an element,
/// counted from 0. out_of_resources if memory runs out.
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
