#include "vantage/volume/advanced/carve.hpp"

#include <tbb/parallel_for.h>

#include "carve/lattice_view.hpp"
#include "classify/fuse_cameras.hpp"
#include "objects/float_resolution.hpp"
#include "objects/known_objects.hpp"

namespace vantage {
namespace volume::detail {
namespace {

/// What one lattice says of the grid, part by part, as a camera whose sight ends at its surface.
class LatticeCarver {
 public:
  LatticeCarver(const LatticeView& lattice, const GridFrame& frame, CameraEvidence& evidence)
      : lattice_(lattice), frame_(frame), sight_(evidence.sight), depth_(*evidence.depth) {}

  void carve(std::size_t chunk) {
    descend(
        frame_.layout.blocks_in_chunk(chunk),
        [&](const CellRange& blocks) { return decide(blocks); },
        [&](const Eigen::Vector3i& block) { compare(block); });
  }

 private:
  bool decide(const CellRange& blocks) {
    const RangeSeen all = lattice_.ask(blocks);
    if (!all.covered || !all.seen) return false;
    blocks.for_each([&](const Eigen::Vector3i& block) {
      const std::size_t index = frame_.layout.index(block);
      if (*all.covered) sight_.covered.set_all(index);
      if (*all.seen) set_seen(index, frame_.layout.inside(index));
    });
    return true;
  }

  void compare(const Eigen::Vector3i& block) {
    const std::size_t index = frame_.layout.index(block);
    const BlockBits inside = frame_.layout.inside(index);
    const BlockSeen voxels = lattice_.compare(block);
    sight_.covered.set(index, voxels.covered & inside);
    set_seen(index, voxels.seen & inside);
  }

  void set_seen(std::size_t block, const BlockBits& seen) {
    sight_.clear.set(block, seen);
    depth_.through.set(block, seen);
  }

  const LatticeView& lattice_;
  const GridFrame& frame_;
  CameraVisibility& sight_;
  DepthEvidence& depth_;
};

CameraEvidence carved_by(const VisibilityMesh& lattice, const Pose& T_grid_world,
                         const GridFrame& frame, const StopToken& stop) {
  CameraEvidence evidence(lattice.camera, frame.layout);
  evidence.depth.emplace(frame.layout);
  const LatticeView view(lattice, T_grid_world, frame);
  LatticeCarver carver(view, frame, evidence);
  tbb::parallel_for(std::size_t(0), frame.layout.chunk_count(), [&](std::size_t chunk) {
    if (stop.stop_requested()) return;
    carver.carve(chunk);
    stop.advance(1);
  });
  return evidence;
}

}  // namespace
}  // namespace volume::detail

std::shared_ptr<const StateGrid> carve(std::span<const VisibilityMesh> lattices,
                                       const GridGeometry& geometry, const WorldModel& known,
                                       const StopToken& stop) {
  for (const VisibilityMesh& lattice : lattices) lattice.check();
  volume::detail::check_meshes(known);
  volume::detail::check_float_resolution(known, geometry);
  const volume::detail::GridFrame frame(geometry);
  const Pose T_grid_world = Pose::from_translation(-geometry.origin());
  stop.expect(lattices.size() * frame.layout.chunk_count());
  const volume::detail::KnownObjects objects(known, frame, T_grid_world, stop);
  std::vector<volume::detail::CameraEvidence> evidence;
  for (const VisibilityMesh& lattice : lattices) {
    evidence.push_back(volume::detail::carved_by(lattice, T_grid_world, frame, stop));
  }
  if (stop.stop_requested()) return nullptr;
  return volume::detail::combine(geometry, objects, evidence, false);
}

}  // namespace vantage
