#include "grid/openvdb.hpp"

#include <openvdb/tools/Prune.h>

#include "grid/mask_blocks.hpp"
#include "grid/state_grid_impl.hpp"
#include "grid/write_stream.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {
namespace volume::detail {
namespace {

void add_state(const openvdb::MaskTree& voxels, VoxelState state, openvdb::Int32Tree& states) {
  for (const MaskBlock& block : mask_blocks(voxels)) {
    if (block.full()) {
      states.addTile(1, block.origin, std::int32_t(state), true);
      continue;
    }
    auto* const leaf = states.touchLeaf(block.origin);
    for_each_on(block.words(), [&](int x, int y, int z) {
      leaf->setValueOn(openvdb::Index(64 * x + 8 * y + z), std::int32_t(state));
    });
  }
}

openvdb::GridBase::Ptr state_grid(const StateGridImpl& grid) {
  const auto states = std::make_shared<openvdb::Int32Tree>(0);
  add_state(grid.occupied, VoxelState::occupied, *states);
  add_state(grid.shadow, VoxelState::shadow, *states);
  add_state(grid.revealed, VoxelState::revealed, *states);
  openvdb::tools::prune(*states);
  const auto result = openvdb::Int32Grid::create(states);
  result->setName("state");
  result->insertMeta("states", openvdb::StringMetadata("0 free, 1 occupied, 2 shadow, 3 revealed"));
  return result;
}

openvdb::GridBase::Ptr bool_grid(const openvdb::MaskTree& voxels, const char* name) {
  const auto result = openvdb::BoolGrid::create(
      std::make_shared<openvdb::BoolTree>(voxels, false, true, openvdb::TopologyCopy()));
  result->setName(name);
  return result;
}

/// OpenVDB's own file writer does not notice a full disk; a stream does.
class VdbWriter : public openvdb::io::Archive {
 public:
  void write_to(std::ostream& file, const openvdb::GridCPtrVec& grids) const {
    Archive::write(file, grids, /*seekable=*/true);
  }
};

openvdb::math::Transform::Ptr index_to_centre(const GridGeometry& geometry) {
  const Eigen::Vector3d first = geometry.centre(Eigen::Vector3i::Zero());
  auto transform = openvdb::math::Transform::createLinearTransform(geometry.voxel_size_m());
  transform->postTranslate({first.x(), first.y(), first.z()});
  return transform;
}

}  // namespace
}  // namespace volume::detail

void StateGrid::write_vdb(const std::filesystem::path& path) const {
  openvdb::initialize();
  const openvdb::GridPtrVec grids = {volume::detail::state_grid(*impl_),
                                     volume::detail::bool_grid(impl_->occupied, "occupied"),
                                     volume::detail::bool_grid(impl_->shadow, "shadow"),
                                     volume::detail::bool_grid(impl_->revealed, "revealed"),
                                     volume::detail::bool_grid(impl_->measured, "measured"),
                                     volume::detail::bool_grid(impl_->unmeasured, "unmeasured"),
                                     volume::detail::bool_grid(impl_->outside, "unseen")};
  const auto transform = volume::detail::index_to_centre(geometry());
  for (const openvdb::GridBase::Ptr& grid : grids) grid->setTransform(transform);
  volume::detail::VdbWriter writer;
  writer.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
  volume::detail::write_stream(path, [&](std::ostream& file) {
    writer.write_to(file, openvdb::GridCPtrVec(grids.begin(), grids.end()));
  });
}

}  // namespace vantage
