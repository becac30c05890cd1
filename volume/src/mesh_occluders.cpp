#include <tbb/parallel_for.h>

#include <map>

#include "occluders.hpp"
#include "vantage/raycore/scene_builder.hpp"

namespace vantage::detail {
namespace {

/// From here on, copies of a mesh share one BVH; below, triangles in the world are faster to hit.
constexpr std::size_t kWorthAnInstance = 500;

enum class Facing : std::int8_t { away = -1, edge_on = 0, towards = 1 };

/// How each triangle looks at the camera; closer to edge on than `margin_m` is not decided.
std::vector<Facing> facings(const TriangleMesh& mesh, const Eigen::Vector3d& camera_centre,
                            double margin_m) {
  std::vector<Facing> result(mesh.triangles().size());
  for (std::size_t t = 0; t < result.size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>();
    const Eigen::Vector3d normal =
        (mesh.corner(t, 1).cast<double>() - a).cross(mesh.corner(t, 2).cast<double>() - a);
    const double height = normal.dot(camera_centre - a), unsure = margin_m * normal.norm();
    result[t] = height > unsure    ? Facing::towards
                : height < -unsure ? Facing::away
                                   : Facing::edge_on;
  }
  return result;
}

class MeshOccluders final : public Occluders {
 public:
  explicit MeshOccluders(std::vector<PlacedMesh> meshes) : meshes_(std::move(meshes)) {
    std::map<const TriangleMesh*, int> copies;
    for (const PlacedMesh& placed : meshes_) ++copies[placed.mesh.get()];
    SceneBuilder builder;
    for (const PlacedMesh& placed : meshes_) {
      if (copies[placed.mesh.get()] > 1 && placed.mesh->triangles().size() >= kWorthAnInstance) {
        builder.add_instance(placed.mesh, placed.T_grid_mesh);
      } else {
        builder.add_mesh(placed.mesh->transformed(placed.T_grid_mesh));
      }
    }
    scene_ = builder.build();
  }

  bool empty() const override { return scene_->triangle_count() == 0; }

  void hidden(std::span<const Eigen::Vector3i>, PointsView centres,
              const Eigen::Vector3d& camera_centre, std::span<std::uint8_t> result) const override {
    scene_->occluded(centres, camera_centre.cast<float>(), result);
  }

  void add_contours(const PinholeCamera& camera, ContourMap& map) const override {
    tbb::parallel_for(std::size_t(0), meshes_.size(),
                      [&](std::size_t i) { add_contours_of(meshes_[i], camera, map); });
  }

 private:
  static void add_contours_of(const PlacedMesh& placed, const PinholeCamera& camera,
                              ContourMap& map) {
    const TriangleMesh mesh = placed.mesh->transformed(placed.T_grid_mesh);
    if (mesh.empty()) return;
    double margin_m = 0;
    for (const Eigen::Vector3f& p : mesh.vertices()) {
      margin_m = std::max(margin_m, double(p.cwiseAbs().maxCoeff()));
    }
    margin_m = 4e-6 * std::max(margin_m, camera.centre().cwiseAbs().maxCoeff());
    const std::vector<Facing> facing = facings(mesh, camera.centre(), margin_m);
    for (const MeshEdge& edge : placed.topology->edges) {
      const bool inner = edge.right != kNoTriangle && facing[edge.left] == facing[edge.right] &&
                         facing[edge.left] != Facing::edge_on;
      if (inner) continue;
      map.add_edge(mesh.vertices()[edge.from].cast<double>(),
                   mesh.vertices()[edge.to].cast<double>(), margin_m);
    }
  }

  std::vector<PlacedMesh> meshes_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace

std::unique_ptr<const Occluders> mesh_occluders(std::vector<PlacedMesh> meshes) {
  return std::make_unique<const MeshOccluders>(std::move(meshes));
}

}  // namespace vantage::detail
