#include "openvdb.hpp"

#include <openvdb/tree/LeafManager.h>

#include <algorithm>

#include "field_surface.hpp"
#include "lattice_view.hpp"
#include "state_grid_impl.hpp"
#include "vantage/volume/carve.hpp"

namespace vantage {
namespace detail {
namespace {

constexpr int kBand = 2;
constexpr float kLeastMargin = 0.05f;  // voxels: no corner of the mesh sits on a voxel's centre

/// How far outside of the unseen space voxels' centres are, in voxels.
class UnseenField {
 public:
  UnseenField(std::span<const DepthLattice> lattices, const GridGeometry& geometry)
      : frame_(geometry), size_(geometry.size()) {
    const Pose T_grid_world = Pose::from_translation(-geometry.origin());
    for (const DepthLattice& lattice : lattices) views_.emplace_back(lattice, T_grid_world, frame_);
  }

  double outside(const Eigen::Vector3i& voxel) const {
    double outside = outside_box(voxel);
    const Eigen::Vector3d centre =
        frame_.voxel_size_m * (voxel.cast<double>() + Eigen::Vector3d::Constant(0.5));
    for (const LatticeView& view : views_) {
      outside = std::max(outside, view.depth_in_seen_m(centre) / frame_.voxel_size_m);
    }
    return std::clamp(outside, -double(kBand), double(kBand));
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

/// Fills in the band; every voxel stays on the side that carving found.
void measure(const UnseenField& distances, const openvdb::MaskTree& unseen,
             openvdb::FloatTree& field) {
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(field);
  leaves.foreach ([&](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    const BlockWords inside = BlockReader(unseen).words(leaf.origin());
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      const float outside = float(distances.outside(to_voxel(voxel.getCoord())));
      voxel.setValue(on_side(outside, is_on(inside, voxel.pos()), kLeastMargin));
    }
  });
}

}  // namespace
}  // namespace detail

TriangleMesh unseen_surface(std::span<const DepthLattice> lattices, const GridGeometry& geometry) {
  const auto grid = carve(lattices, geometry, {});
  const openvdb::MaskTree& unseen = grid->impl().shadow;
  const auto field = detail::field_around(unseen, detail::kBand, float(detail::kBand));
  detail::measure(detail::UnseenField(lattices, geometry), unseen, field->tree());
  return detail::field_surface(*field, geometry, "unseen surface");
}

}  // namespace vantage
