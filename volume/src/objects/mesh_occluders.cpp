#include <tbb/parallel_for.h>

#include <map>

#include "objects/occluders.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::volume::detail {
namespace {

/// From here on, copies of a mesh share one BVH; below, triangles in the world are faster to hit.
constexpr std::size_t kWorthAnInstance = 500;

enum class Facing : std::int8_t { away = -1, edge_on = 0, towards = 1 };

/// How each triangle looks at the camera; closer to edge on than `margin_m` is not decided.
std::vector<Facing> facings(const MeshTopology& topology, const Eigen::Vector3d& camera_centre,
                            double margin_m) {
  std::vector<Facing> result(topology.planes.size());
  for (std::size_t t = 0; t < result.size(); ++t) {
    const FacePlane& plane = topology.planes[t];
    const double height = plane.normal.dot(camera_centre) - plane.offset;
    result[t] = height > margin_m    ? Facing::towards
                : height < -margin_m ? Facing::away
                                     : Facing::edge_on;
  }
  return result;
}

class MeshOccluders final : public Occluders {
 public:
  explicit MeshOccluders(std::vector<PlacedMesh> meshes) : meshes_(std::move(meshes)) {
    const std::vector<bool> shared = share_geometry(meshes_);
    SceneBuilder builder;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const PlacedMesh& placed = meshes_[i];
      if (shared[i]) {
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
    const Eigen::Vector3d camera_in_mesh = placed.T_grid_mesh.inverse() * camera.centre();
    double reach_m = camera_in_mesh.norm();
    for (const Eigen::Vector3f& p : placed.mesh->vertices()) {
      reach_m = std::max(reach_m, double(p.norm()));
    }
    reach_m += placed.T_grid_mesh.translation().norm();
    const double margin_m = kRoundingOfRays * reach_m;
    const std::vector<Facing> facing = facings(*placed.topology, camera_in_mesh, margin_m);
    const auto vertex = [&](std::uint32_t index) -> Eigen::Vector3d {
      return placed.T_grid_mesh * placed.mesh->vertices()[index].cast<double>();
    };
    for (const MeshEdge& edge : placed.topology->edges) {
      const bool inner = edge.right != kNoTriangle && facing[edge.left] == facing[edge.right] &&
                         facing[edge.left] != Facing::edge_on;
      if (!inner) map.add_edge(vertex(edge.from), vertex(edge.to), margin_m);
    }
  }

  std::vector<PlacedMesh> meshes_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace

std::vector<bool> share_geometry(const std::vector<PlacedMesh>& meshes) {
  std::map<const TriangleMesh*, int> copies;
  for (const PlacedMesh& placed : meshes) ++copies[placed.mesh.get()];
  std::vector<bool> shared;
  for (const PlacedMesh& placed : meshes) {
    shared.push_back(copies[placed.mesh.get()] > 1 &&
                     placed.mesh->triangles().size() >= kWorthAnInstance);
  }
  return shared;
}

std::unique_ptr<const Occluders> mesh_occluders(std::vector<PlacedMesh> meshes) {
  return std::make_unique<const MeshOccluders>(std::move(meshes));
}

}  // namespace vantage::volume::detail
