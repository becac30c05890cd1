#include "grid/openvdb.hpp"

#include <openvdb/tools/Morphology.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <utility>

#include "carve/lattice_view.hpp"
#include "grid/state_grid_impl.hpp"
#include "shadow/shell_voxels.hpp"
#include "surface/field_surface.hpp"
#include "vantage/volume/advanced/carve.hpp"

namespace vantage {
namespace volume::detail {
namespace {

constexpr int kFieldBand = 2;
constexpr float kCornerMargin = 0.05f;  // voxels: no corner of the mesh sits on a voxel's centre

/// How far outside of the unseen space voxels' centres are, in voxels.
class UnseenField {
 public:
  UnseenField(std::span<const VisibilityMesh> lattices, const GridGeometry& geometry)
      : frame_(geometry), size_(geometry.size()) {
    const Pose T_grid_world = Pose::from_translation(-geometry.origin());
    for (const VisibilityMesh& lattice : lattices)
      views_.emplace_back(lattice, T_grid_world, frame_);
  }

  double outside(const Eigen::Vector3i& voxel) const {
    double outside = outside_box(voxel);
    const Eigen::Vector3d centre =
        frame_.voxel_size_m * (voxel.cast<double>() + Eigen::Vector3d::Constant(0.5));
    for (const LatticeView& view : views_) {
      outside = std::max(outside, view.depth_in_seen_m(centre) / frame_.voxel_size_m);
    }
    return std::clamp(outside, -double(kFieldBand), double(kFieldBand));
  }

 private:
  /// The grid's box ends half a voxel from its outermost centres.
  double outside_box(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3d at = voxel.cast<double>();
    return (-0.5 - at.array()).max(at.array() + 0.5 - size_.cast<double>().array()).maxCoeff();
  }

  GridFrame frame_;
  Eigen::Vector3i size_;
  std::vector<LatticeView> views_;
};

/// Outside of what nothing counts as unseen, and how far outside of it voxels' centres are, in
/// voxels, near its faces.
class Shell {
 public:
  explicit Shell(openvdb::MaskTree voxels) : voxels_(std::move(voxels)), core_(voxels_) {
    namespace tools = openvdb::tools;
    tools::erodeActiveValues(core_, 1, tools::NN_FACE_EDGE_VERTEX, tools::IGNORE_TILES);
  }

  const openvdb::MaskTree& voxels() const { return voxels_; }

  double outside(const openvdb::Coord& voxel) const {
    if (core_.isValueOn(voxel)) return -kFieldBand;
    return voxels_.isValueOn(voxel) ? -0.5 : 0.5;
  }

 private:
  openvdb::MaskTree voxels_, core_;  ///< core_: those that all have their 26 neighbours
};

/// Fills in the band; every voxel stays on the side that carving found.
void measure(const UnseenField& distances, const Shell* shell, const openvdb::MaskTree& unseen,
             openvdb::FloatTree& field) {
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(field);
  leaves.foreach ([&](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    const BlockWords inside = BlockReader(unseen).words(leaf.origin());
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      double outside = distances.outside(to_voxel(voxel.getCoord()));
      if (shell != nullptr) outside = std::max(outside, shell->outside(voxel.getCoord()));
      voxel.setValue(on_side(float(outside), is_on(inside, voxel.pos()), kCornerMargin));
    }
  });
}

TriangleMesh surface(std::span<const VisibilityMesh> lattices, const GridGeometry& geometry,
                     const Shell* shell) {
  openvdb::MaskTree unseen = carve(lattices, geometry, {})->impl().shadow;
  if (shell != nullptr) unseen.topologyIntersection(shell->voxels());
  const auto field = field_around(unseen, kFieldBand, float(kFieldBand));
  measure(UnseenField(lattices, geometry), shell, unseen, field->tree());
  return field_surface(*field, geometry, "unseen surface");
}

}  // namespace
}  // namespace volume::detail

TriangleMesh unseen_surface(std::span<const VisibilityMesh> lattices,
                            const GridGeometry& geometry) {
  return volume::detail::surface(lattices, geometry, nullptr);
}

TriangleMesh unseen_surface(std::span<const VisibilityMesh> lattices, const StateGrid& filtered) {
  const volume::detail::Shell shell(volume::detail::shell_voxels(filtered));
  return volume::detail::surface(lattices, filtered.geometry(), &shell);
}

}  // namespace vantage
