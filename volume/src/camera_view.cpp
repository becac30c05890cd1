#include "camera_view.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::detail {
namespace {

bool in_range(float depth, const DepthRange& range) {  // NaN is in no range
  return depth >= float(range.near_m) && depth <= float(range.far_m);
}

}  // namespace

/// Voxels of one block that are still in question.
struct CameraView::Candidates {
  Points centres;
  std::vector<int> offsets;

  /// Keeps the ones for which `keep(i)` holds.
  template <class Keep>
  void filter(const Keep& keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      if (!keep(i)) continue;
      centres.set(kept, centres[i]);
      offsets[kept++] = offsets[i];
    }
    centres.resize(kept);
    offsets.resize(kept);
  }
};

CameraView::CameraView(const Observer& observer, const GridGeometry& geometry,
                       const BlockLayout& layout, const Scene* known)
    : observer_(observer),
      geometry_(geometry),
      layout_(layout),
      known_(known),
      measured_points_(layout) {
  if (observer.depth != nullptr) mark_measured_points();
}

void CameraView::mark_measured_points() {
  const DepthImage& depth = *observer_.depth;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float d = depth.at(u, v);
      if (!in_range(d, observer_.camera.range())) continue;
      const Eigen::Vector3d point = observer_.camera.unproject(u, v, double(d));
      if (const auto voxel = geometry_.voxel_at(point)) measured_points_.set(*voxel);
    }
  }
}

void CameraView::add_block(std::size_t block, Evidence& evidence) const {
  Candidates candidates;
  candidates.centres.reserve(kBlockVoxels);
  candidates.offsets.reserve(kBlockVoxels);
  layout_.for_each_voxel(block, [&](const Eigen::Vector3i& voxel, int offset) {
    if (evidence.solid.test(block, offset) || evidence.free.test(block, offset)) return;
    candidates.centres.push_back(geometry_.centre(voxel).cast<float>());
    candidates.offsets.push_back(offset);
  });
  keep_in_view(candidates);
  if (observer_.depth != nullptr) compare_with_depth(candidates, block, evidence);
  if (known_ != nullptr && !candidates.offsets.empty()) {
    std::vector<std::uint8_t> hidden(candidates.offsets.size());
    known_->occluded(candidates.centres, observer_.camera.centre().cast<float>(), hidden);
    candidates.filter([&](std::size_t i) { return hidden[i] == 0; });
  }
  for (const int offset : candidates.offsets) evidence.free.set(block, offset);
}

void CameraView::keep_in_view(Candidates& candidates) const {
  std::vector<std::uint8_t> in_view(candidates.offsets.size());
  observer_.camera.in_view(candidates.centres, in_view);
  candidates.filter([&](std::size_t i) { return in_view[i] != 0; });
}

void CameraView::compare_with_depth(Candidates& candidates, std::size_t block,
                                    Evidence& evidence) const {
  const std::size_t count = candidates.offsets.size();
  std::vector<float> u(count), v(count), z(count);
  observer_.camera.project(candidates.centres, u, v, z);
  const DepthImage& depth = *observer_.depth;
  const float half_voxel = float(0.5 * geometry_.voxel_size_m());
  candidates.filter([&](std::size_t i) {
    // A centre on the image's very border may be rounded over it.
    const int pixel_u = std::clamp(int(std::floor(u[i] + 0.5f)), 0, depth.width() - 1);
    const int pixel_v = std::clamp(int(std::floor(v[i] + 0.5f)), 0, depth.height() - 1);
    const float measured = depth.at(pixel_u, pixel_v);
    const bool holds_point = measured_points_.test(block, candidates.offsets[i]);
    const bool known_depth = in_range(measured, observer_.camera.range());
    if (holds_point || (known_depth && std::abs(z[i] - measured) <= half_voxel)) {
      evidence.surface.set(block, candidates.offsets[i]);
      return false;
    }
    return known_depth && z[i] < measured;
  });
}

}  // namespace vantage::detail
