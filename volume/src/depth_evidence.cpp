#include "depth_evidence.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "min_pyramid.hpp"

namespace vantage::detail {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

/// Pixels [u0, u1] × [v0, v1].
struct PixelRect {
  int u0, u1, v0, v1;
};

/// The surface band of every pixel: from `front` to `back`, both `kNothing` where it is unknown.
class SurfaceBands {
 public:
  SurfaceBands(const DepthImage& depth, const DepthRange& range, double voxel_size_m,
               const VolumeOptions& options)
      : width_(depth.width()), front_(depth.metres().size()), back_(front_.size()) {
    std::vector<float> negative_back(front_.size());
    tbb::parallel_for(0, depth.height(), [&](int v) {
      for (int u = 0; u < width_; ++u) {
        const std::size_t i = index(u, v);
        const float d = depth.metres()[i];
        const bool known = d >= float(range.near_m) && d <= float(range.far_m);  // NaN is not
        const float half =
            0.5f *
            float(std::max(voxel_size_m, options.band_sigmas * options.noise.sigma_m(double(d))));
        front_[i] = known ? d - half : kNothing;
        back_[i] = known ? d + half : kNothing;
        negative_back[i] = -back_[i];
      }
    });
    nearest_front_ = MinPyramid(width_, depth.height(), front_);
    farthest_back_ = MinPyramid(width_, depth.height(), std::move(negative_back));
  }

  float front(int u, int v) const { return front_[index(u, v)]; }
  float back(int u, int v) const { return back_[index(u, v)]; }

  /// No more than the smallest front, and no less than the largest back, over some pixels.
  float nearest_front(const PixelRect& r) const {
    return nearest_front_.min_over(r.u0, r.u1, r.v0, r.v1);
  }
  float farthest_back(const PixelRect& r) const {
    return -farthest_back_.min_over(r.u0, r.u1, r.v0, r.v1);
  }

 private:
  std::size_t index(int u, int v) const {
    return std::size_t(v) * std::size_t(width_) + std::size_t(u);
  }

  int width_;
  std::vector<float> front_, back_;
  MinPyramid nearest_front_, farthest_back_;
};

class DepthComparison {
 public:
  DepthComparison(const PinholeCamera& camera, const DepthImage& depth, const GridFrame& frame,
                  const BlockSet& covered, const VolumeOptions& options, DepthEvidence& evidence)
      : camera_(camera),
        depth_(depth),
        projector_(camera),
        frame_(frame),
        covered_(covered),
        bands_(depth, camera.range(), frame.voxel_size_m, options),
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
    const PixelRect pixels = pixels_of(box.rect);
    if (double(bands_.farthest_back(pixels)) < box.z_min) return true;  // behind, or unknown
    if (!(double(bands_.nearest_front(pixels)) > box.z_max)) return false;
    blocks.for_each([&](const Eigen::Vector3i& block) {
      const std::size_t index = frame_.layout.index(block);
      evidence_.through.set(index, covered_.bits(index));
    });
    return true;
  }

  void compare_block(const Eigen::Vector3i& block) {
    const std::size_t index = frame_.layout.index(block);
    const BlockBits covered = covered_.bits(index);
    const VoxelList list(frame_, block, covered);
    const std::size_t count = list.voxels.size();
    std::vector<float> u(count), v(count), z(count);
    camera_.project(list.centres, u, v, z);
    BlockBits through, surface = measured_points(block) & covered;
    for (std::size_t i = 0; i < count; ++i) {
      // A centre on the image's very border may be rounded over it.
      const int pixel_u = std::clamp(int(std::floor(u[i] + 0.5f)), 0, depth_.width() - 1);
      const int pixel_v = std::clamp(int(std::floor(v[i] + 0.5f)), 0, depth_.height() - 1);
      const int offset = offset_in_block(list.voxels[i]);
      if (z[i] < bands_.front(pixel_u, pixel_v)) {
        through.set(offset);
      } else if (z[i] <= bands_.back(pixel_u, pixel_v)) {
        surface.set(offset);
      }
    }
    evidence_.surface.set(index, surface);
    evidence_.through.set(index, through & ~surface);
  }

  /// The voxels of a block in which the camera measured a point. Those points are among the pixels
  /// over the block.
  BlockBits measured_points(const Eigen::Vector3i& block) const {
    const BoxInView box = project({block, block.array() + 1});
    const PixelRect pixels = pixels_of(box.rect);
    BlockBits bits;
    for (int v = pixels.v0; v <= pixels.v1; ++v) {
      for (int u = pixels.u0; u <= pixels.u1; ++u) {
        const float d = depth_.at(u, v);
        if (!(double(d) >= box.z_min && double(d) <= box.z_max)) continue;
        if (bands_.back(u, v) == kNothing) continue;
        const Eigen::Vector3d point = camera_.unproject(u, v, double(d)) / frame_.voxel_size_m;
        const Eigen::Vector3i voxel = point.array().floor().cast<int>();
        if ((voxel.array() < 0).any()) continue;
        if (voxel / kBlockSide == block) bits.set(offset_in_block(voxel));
      }
    }
    return bits;
  }

  BoxInView project(const CellRange& blocks) const {
    const Extent extent = frame_.extent(frame_.layout.voxels_in(blocks));
    return projector_.project(extent, projector_.margin_m(extent));
  }

  /// The pixels that are nearest to some point of a rectangle, and one more to each side.
  PixelRect pixels_of(const ImageRect& rect) const {
    const auto pixel = [](double p, int count) {
      return std::clamp(int(std::floor(p + 0.5)), 0, count - 1);
    };
    return {pixel(rect.u0 - 1, depth_.width()), pixel(rect.u1 + 1, depth_.width()),
            pixel(rect.v0 - 1, depth_.height()), pixel(rect.v1 + 1, depth_.height())};
  }

  const PinholeCamera& camera_;
  const DepthImage& depth_;
  BoxProjector projector_;
  const GridFrame& frame_;
  const BlockSet& covered_;
  SurfaceBands bands_;
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

}  // namespace vantage::detail
