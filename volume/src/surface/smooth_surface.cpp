#include "vantage/volume/advanced/smooth_surface.hpp"

#include "grid/openvdb.hpp"

#include <openvdb/tools/Filter.h>
#include <openvdb/tree/LeafManager.h>

#include "grid/mask_blocks.hpp"
#include "grid/state_grid_impl.hpp"
#include "surface/field_surface.hpp"

namespace vantage {
namespace volume::detail {
namespace {

namespace tools = openvdb::tools;

constexpr int kGaussianReach = 4;    // how many voxels deep the Gaussian reaches: four means of 3³
constexpr float kHalf = 0.5f;        // the indicator's value: the surface is halfway
constexpr float kSideMargin = 0.1f;  // a centre keeps at least this much of its own side

/// Brings every voxel of the field back to its own side of the surface.
void keep_sides(const openvdb::MaskTree& voxels, openvdb::FloatTree& field) {
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(field);
  leaves.foreach ([&](openvdb::FloatTree::LeafNodeType& leaf, std::size_t) {
    const BlockWords inside = BlockReader(voxels).words(leaf.origin());
    for (openvdb::Index n = 0; n < leaf.SIZE; ++n) {
      leaf.setValueOnly(n, on_side(leaf.getValue(n), is_on(inside, n), kSideMargin));
    }
  });
}

TriangleMesh smooth_surface(const openvdb::MaskTree& voxels, const GridGeometry& geometry) {
  const openvdb::FloatGrid::Ptr field = field_around(voxels, kGaussianReach, kHalf);
  tools::Filter<openvdb::FloatGrid>(*field).gaussian();
  keep_sides(voxels, field->tree());
  return field_surface(*field, geometry, "smooth surface");
}

}  // namespace
}  // namespace volume::detail

TriangleMesh smooth_surface(const StateGrid& grid, VoxelState state) {
  return volume::detail::with_voxels(grid.impl(), state, [&](const openvdb::MaskTree& voxels) {
    return volume::detail::smooth_surface(voxels, grid.geometry());
  });
}

}  // namespace vantage
