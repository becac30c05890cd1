#include "classify/depth_integration.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

#include "classify/truncation_band.hpp"
#include "vantage/raycore/detail/box_projector.hpp"

namespace vantage::volume::detail {
namespace {

class DepthComparison {
 public:
  DepthComparison(const PinholeCamera& camera, const DepthImage& depth, const GridFrame& frame,
                  const BlockSet& covered, const VolumeOptions& options, DepthEvidence& evidence)
      : camera_(camera),
        projector_(camera),
        frame_(frame),
        covered_(covered),
        bands_(camera, depth, frame, options),
        evidence_(evidence) {}

  void compare(std::size_t chunk) {
    descend(
        frame_.layout.blocks_in_chunk(chunk),
        [&](const CellRange& blocks) { return decide(blocks); },
        [&](const Eigen::Vector3i& block) { compare_block(block); });
  }

 private:
  bool decide(const CellRange& blocks) {
    bool any = false;
    blocks.for_each([&](const Eigen::Vector3i& block) {
      any = any || !covered_.none(frame_.layout.index(block));
    });
    if (!any) return true;
    const BoxInView box = project(blocks);
    const PixelRect pixels = bands_.pixels_of(box.rect);
    const double nearest = double(bands_.nearest_front(pixels));
    const double farthest = double(bands_.farthest_back(pixels));
    if (farthest < box.z_min && std::isfinite(nearest)) return true;  // behind, and all are known
    const bool unknown = std::isinf(farthest) && farthest < 0;
    if (!unknown && !(nearest > box.z_max)) return false;
    BlockSet& one_answer = unknown ? evidence_.unknown : evidence_.through;
    blocks.for_each([&](const Eigen::Vector3i& block) {
      const std::size_t index = frame_.layout.index(block);
      one_answer.set(index, covered_.bits(index));
    });
    return true;
  }

  void compare_block(const Eigen::Vector3i& block) {
    const std::size_t index = frame_.layout.index(block);
    const BlockBits covered = covered_.bits(index);
    const BlockVoxels voxels(frame_, block, covered);
    const std::size_t count = voxels.size();
    float u[kBlockVoxels], v[kBlockVoxels], z[kBlockVoxels];
    camera_.project(voxels.centres(), {u, count}, {v, count}, {z, count});
    std::uint8_t through[kBlockVoxels], surface[kBlockVoxels], unknown[kBlockVoxels];
    bands_.compare(u, v, z, count, through, surface, unknown);
    // The points in a block were measured at the pixels over it.
    const PixelRect pixels = bands_.pixels_of(project({block, block.array() + 1}).rect);
    const BlockBits measured = bands_.measured_points(index, pixels) & covered;
    evidence_.surface.set(index, voxels.where(surface, 1) | measured);
    evidence_.through.set(index, voxels.where(through, 1) & ~measured);
    evidence_.unknown.set(index, voxels.where(unknown, 1) & ~measured);
  }

  BoxInView project(const CellRange& blocks) const {
    const Extent extent = frame_.extent(frame_.layout.voxels_in(blocks));
    return projector_.project(extent, projector_.margin_m(extent));
  }

  const PinholeCamera& camera_;
  BoxProjector projector_;
  const GridFrame& frame_;
  const BlockSet& covered_;
  DepthBands bands_;
  DepthEvidence& evidence_;
};

}  // namespace

DepthEvidence compare_with_depth(const PinholeCamera& camera, const DepthImage& depth,
                                 const GridFrame& frame, const BlockSet& covered,
                                 const VolumeOptions& options, const StopToken& stop) {
  DepthEvidence evidence(frame.layout);
  DepthComparison comparison(camera, depth, frame, covered, options, evidence);
  tbb::parallel_for(std::size_t(0), frame.layout.chunk_count(), [&](std::size_t chunk) {
    if (stop.stop_requested()) return;
    comparison.compare(chunk);
    stop.advance(1);
  });
  return evidence;
}

}  // namespace vantage::volume::detail
