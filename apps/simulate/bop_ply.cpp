#include "simulate/bop_ply.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <vector>

namespace vantage {
namespace {

/// A vertex of the file: one of the mesh's, with one of the places on the texture that it has.
struct FileVertices {
  std::vector<std::uint32_t> of_mesh;  ///< file vertex → mesh vertex
  std::vector<Eigen::Vector2f> uv;     ///< texels; empty without texture
  std::vector<Triangle> triangles;
};

FileVertices split_by_texture(const TexturedMesh& shape) {
  FileVertices file;
  if (!shape.textured()) {
    for (std::uint32_t i = 0; i < shape.mesh.vertices().size(); ++i) file.of_mesh.push_back(i);
    file.triangles = shape.mesh.triangles();
    return file;
  }
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
  for (std::size_t t = 0; t < shape.uv.size(); ++t) {
    Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = shape.mesh.triangles()[t][corner];
      const Eigen::Vector2f& uv = shape.uv[t][corner];
      const auto [entry, is_new] =
          known.try_emplace({vertex, uv.x(), uv.y()}, std::uint32_t(file.of_mesh.size()));
      if (is_new) file.of_mesh.push_back(vertex), file.uv.push_back(uv);
      triangle[corner] = entry->second;
    }
    file.triangles.push_back(triangle);
  }
  return file;
}

/// Normals of the mesh's vertices; vertices at one place count as one only if they are one.
std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices().size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto at = [&](int corner) -> Eigen::Vector3d {
      return mesh.corner(t, corner % 3).cast<double>();
    };
    const Eigen::Vector3d face = (at(1) - at(0)).cross(at(2) - at(0)).stableNormalized();
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d a = (at(corner + 1) - at(corner)).stableNormalized();
      const Eigen::Vector3d b = (at(corner + 2) - at(corner)).stableNormalized();
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      normals[mesh.triangles()[t][std::size_t(corner)]] += angle * face;
    }
  }
  for (Eigen::Vector3d& normal : normals) normal = normal.stableNormalized();
  return normals;
}

std::string header(const TexturedMesh& shape, const FileVertices& file, const std::string& name,
                   const std::string& texture_file) {
  std::string text = fmt::format("ply\nformat ascii 1.0\ncomment {}, millimetres\n", name);
  if (shape.textured()) text += "comment TextureFile " + texture_file + "\n";
  text += fmt::format("element vertex {}\n", file.of_mesh.size());
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz"}) {
    text += fmt::format("property float {}\n", property);
  }
  text += shape.textured() ? "property float texture_u\nproperty float texture_v\n"
                           : "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                      file.triangles.size());
  return text;
}

}  // namespace

std::string bop_ply(const TexturedMesh& shape, const std::string& name,
                    const std::string& texture_file) {
  const FileVertices file = split_by_texture(shape);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(shape.mesh);
  const Eigen::Vector3i color =
      (shape.color * 255).array().round().max(0).min(255).cast<int>().matrix();
  std::string text = header(shape, file, name, texture_file);
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < file.of_mesh.size(); ++i) {
    const Eigen::Vector3d p = 1000 * shape.mesh.vertices()[file.of_mesh[i]].cast<double>();
    const Eigen::Vector3d& n = normals[file.of_mesh[i]];
    fmt::format_to(out, "{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}", p.x(), p.y(), p.z(), n.x(),
                   n.y(), n.z());
    if (shape.textured()) {
      fmt::format_to(out, " {:.7f} {:.7f}\n", file.uv[i].x() / float(shape.texture.width),
                     1 - file.uv[i].y() / float(shape.texture.height));
    } else {
      fmt::format_to(out, " {} {} {}\n", color.x(), color.y(), color.z());
    }
  }
  for (const Triangle& t : file.triangles) fmt::format_to(out, "3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace vantage
