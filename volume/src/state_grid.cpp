#include "vantage/volume/state_grid.hpp"

#include <fmt/format.h>
#include "openvdb.hpp"

#include "state_grid_impl.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/file.hpp"
#include "voxel_faces.hpp"

namespace vantage {

StateGrid::StateGrid(std::unique_ptr<const detail::StateGridImpl> impl) : impl_(std::move(impl)) {}
StateGrid::~StateGrid() = default;

const GridGeometry& StateGrid::geometry() const noexcept {
  return impl_->geometry;
}

VoxelState StateGrid::at(const Eigen::Vector3i& voxel) const {
  return VoxelState(impl_->states.getValue(detail::to_coord(voxel)));
}

bool StateGrid::measured(const Eigen::Vector3i& voxel) const {
  return impl_->measured.isValueOn(detail::to_coord(voxel));
}

std::uint64_t StateGrid::count(VoxelState state) const noexcept {
  return impl_->counts[std::size_t(state)];
}

Points StateGrid::centres(VoxelState state) const {
  Points points;
  points.reserve(count(state));
  for (auto leaf = impl_->states.cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      if (*value != std::int32_t(state)) continue;
      points.push_back(geometry().centre(detail::to_voxel(value.getCoord())).cast<float>());
    }
  }
  return points;
}

std::shared_ptr<const StateGrid> StateGrid::with_revealed(
    std::span<const std::uint8_t> seen) const {
  if (seen.size() != count(VoxelState::shadow)) {
    throw bad_input("revealed voxels", fmt::format("there are {} flags for {} shadow voxels",
                                                   seen.size(), count(VoxelState::shadow)));
  }
  auto impl = std::make_unique<detail::StateGridImpl>(*impl_);
  std::size_t next = 0;
  for (auto leaf = impl->states.beginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->beginValueOn(); value; ++value) {
      if (*value != std::int32_t(VoxelState::shadow) || seen[next++] == 0) continue;
      value.setValue(std::int32_t(VoxelState::revealed));
      --impl->counts[std::size_t(VoxelState::shadow)];
      ++impl->counts[std::size_t(VoxelState::revealed)];
    }
  }
  return std::make_shared<const StateGrid>(std::move(impl));
}

TriangleMesh StateGrid::faces(VoxelState state) const {
  openvdb::MaskTree voxels(false);
  for (auto value = impl_->states.cbeginValueOn(); value; ++value) {
    if (*value == std::int32_t(state)) voxels.setValueOn(value.getCoord());
  }
  return detail::voxel_faces(voxels, geometry());
}

TriangleMesh StateGrid::measured_faces() const {
  return detail::voxel_faces(impl_->measured, geometry());
}

void StateGrid::write_vdb(const std::filesystem::path& path) const {
  openvdb::initialize();
  // A copy that shares nothing but the tree: the file's transform is at the voxel's centre.
  const openvdb::Int32Grid::Ptr grid =
      openvdb::Int32Grid::create(std::make_shared<openvdb::Int32Tree>(impl_->states));
  const Eigen::Vector3d first = geometry().centre(Eigen::Vector3i::Zero());
  openvdb::math::Transform::Ptr transform =
      openvdb::math::Transform::createLinearTransform(geometry().voxel_size_m());
  transform->postTranslate({first.x(), first.y(), first.z()});
  grid->setTransform(transform);
  grid->setName("state");
  grid->insertMeta("states", openvdb::StringMetadata("0 free, 1 occupied, 2 shadow, 3 revealed"));
  write_file_with(path, [&](const std::filesystem::path& temporary) {
    openvdb::io::File file(temporary.string());
    file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write({grid});
  });
}

}  // namespace vantage
