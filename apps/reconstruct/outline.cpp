#include "reconstruct/outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace vantage {
namespace {

constexpr double kSharp = 0.87;      // cosine between the normals of faces that meet in an edge
constexpr double kPiece_px = 6;      // how long a piece may get
constexpr int kMaxPieces = 400;      // of one edge
constexpr double kInFront_m = 2e-3;  // how far a point is drawn towards the camera before it is
                                     // asked whether something hides it
constexpr double kNearest_m = 1e-3;

/// A point that is drawn, or not: behind the camera it has no pixel.
std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector3d& p_cam, const Lens& lens) {
  if (p_cam.z() < kNearest_m) return std::nullopt;
  const Intrinsics& k = lens.intrinsics();
  if (lens.distortion().model == LensModel::fisheye) {
    if (p_cam.head<2>().norm() > lens.reach() * p_cam.z()) return std::nullopt;
    return lens.project(p_cam);
  }
  // Far outside of the image the lens' polynomial means nothing.
  const Eigen::Vector2d straight(k.fx * p_cam.x() / p_cam.z() + k.cx,
                                 k.fy * p_cam.y() / p_cam.z() + k.cy);
  if (straight.x() < -0.5 * k.width || straight.x() > 1.5 * k.width ||
      straight.y() < -0.5 * k.height || straight.y() > 1.5 * k.height) {
    return std::nullopt;
  }
  return lens.project(p_cam);
}

/// Whether an edge is worth a line: the rim of the mesh, sharp, or a silhouette.
bool is_drawn(const MeshEdge& edge, const Eigen::Vector3d& eye) {
  if (edge.normals.size() != 2) return true;
  const Eigen::Vector3d &a = edge.normals[0], &b = edge.normals[1];
  const double side_a = a.dot(eye - edge.from), side_b = b.dot(eye - edge.from);
  return a.dot(b) < kSharp || (side_a > 0) != (side_b > 0);
}

}  // namespace

std::vector<MeshEdge> edges_of(const TriangleMesh& mesh) {
  using Corner = std::array<float, 3>;
  const auto corner = [](const Eigen::Vector3f& p) { return Corner{p.x(), p.y(), p.z()}; };
  std::map<std::pair<Corner, Corner>, MeshEdge> edges;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    std::array<Eigen::Vector3d, 3> p;
    for (int c = 0; c < 3; ++c) p[std::size_t(c)] = mesh.corner(t, c).cast<double>();
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    for (int c = 0; c < 3; ++c) {
      const Corner a = corner(mesh.corner(t, c)), b = corner(mesh.corner(t, (c + 1) % 3));
      MeshEdge& edge = edges[std::minmax(a, b)];
      edge.from = p[std::size_t(c)], edge.to = p[std::size_t((c + 1) % 3)];
      edge.normals.push_back(normal);
    }
  }
  std::vector<MeshEdge> list;
  for (auto& [corners, edge] : edges) list.push_back(std::move(edge));
  return list;
}

std::vector<OutlinePiece> outline(const std::vector<MeshEdge>& edges, const Pose& T_world_object,
                                  const Lens& lens, const Pose& T_world_cam, const Scene& scene) {
  const Pose T_cam_world = T_world_cam.inverse(), T_cam_object = T_cam_world * T_world_object;
  const Eigen::Vector3d eye = T_world_object.inverse() * T_world_cam.translation();
  const Eigen::Vector3f eye_world = T_world_cam.translation().cast<float>();
  std::vector<OutlinePiece> pieces;
  for (const MeshEdge& edge : edges) {
    if (!is_drawn(edge, eye)) continue;
    const auto from = pixel_of(T_cam_object * edge.from, lens);
    const auto to = pixel_of(T_cam_object * edge.to, lens);
    if (!from || !to) continue;
    const int count = std::clamp(int(std::ceil((*to - *from).norm() / kPiece_px)), 1, kMaxPieces);
    Eigen::Vector2d last = *from;
    for (int i = 1; i <= count; ++i) {
      const auto along = [&](double s) -> Eigen::Vector3d {
        return edge.from + s / count * (edge.to - edge.from);
      };
      const auto next = pixel_of(T_cam_object * along(i), lens);
      if (!next) break;
      const Eigen::Vector3d middle = along(i - 0.5);
      const Eigen::Vector3d in_front = middle + kInFront_m * (eye - middle).normalized();
      const Eigen::Vector3f p_world = (T_world_object * in_front).cast<float>();
      pieces.push_back({last, *next, !scene.occluded(p_world, eye_world)});
      last = *next;
    }
  }
  return pieces;
}

}  // namespace vantage
