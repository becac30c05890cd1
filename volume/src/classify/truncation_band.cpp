#include "classify/truncation_band.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::volume::detail {
namespace {

constexpr int kCell = 4;
constexpr float kNothing = -std::numeric_limits<float>::infinity();
/// The back of a band beyond the far limit: what is before its front is free, and there is no
/// surface.
constexpr float kBeyondRange = std::numeric_limits<float>::infinity();

/// What the kernels need, in plain arrays.
struct RowInput {
  const float* depth;
  int width;
  float near_m, far_m;
  float half_voxel, noise;  ///< half the band is max(half_voxel, noise · d²)
  // The point of pixel u at depth d, in voxels: centre + d · (row + u · column).
  double centre[3], row[3], column[3];
  int size[3];  ///< voxels of the grid
  int blocks_y, blocks_z;
};

[[gnu::always_inline]] inline void bands_body(const RowInput& in, float* __restrict front,
                                              float* __restrict back) {
  for (int u = 0; u < in.width; ++u) {
    const float d = in.depth[u];
    const float noise = in.noise * d * d;
    const float half = noise > in.half_voxel ? noise : in.half_voxel;
    const bool known = d >= in.near_m;  // NaN is not
    const bool surface = d <= in.far_m;
    front[u] = known ? d - half : kNothing;
    back[u] = known ? (surface ? d + half : kBeyondRange) : kNothing;
  }
}
constexpr Multiversion<bands_body> bands_kernel;

[[gnu::always_inline]] inline void points_body(const RowInput& in, const float* __restrict back,
                                               std::int32_t* __restrict block,
                                               std::uint16_t* __restrict offset) {
  for (int u = 0; u < in.width; ++u) {
    const bool known = (back[u] > 0) & (back[u] < kBeyondRange);
    const double d = known ? double(in.depth[u]) : 0.0;
    const double x = in.centre[0] + d * (in.row[0] + u * in.column[0]);
    const double y = in.centre[1] + d * (in.row[1] + u * in.column[1]);
    const double z = in.centre[2] + d * (in.row[2] + u * in.column[2]);
    const bool inside = known & (x >= 0) & (x < in.size[0]) & (y >= 0) & (y < in.size[1]) &
                        (z >= 0) & (z < in.size[2]);
    const int i = inside ? int(x) : 0, j = inside ? int(y) : 0, k = inside ? int(z) : 0;
    block[u] = inside ? ((i >> 3) * in.blocks_y + (j >> 3)) * in.blocks_z + (k >> 3) : -1;
    offset[u] = std::uint16_t(((i & 7) << 6) | ((j & 7) << 3) | (k & 7));
  }
}
constexpr Multiversion<points_body> points_kernel;

[[gnu::always_inline]] inline void compare_body(
    const float* __restrict front, const float* __restrict back, int width, int height,
    const float* __restrict u, const float* __restrict v, const float* __restrict depth,
    std::size_t count, std::uint8_t* __restrict through, std::uint8_t* __restrict surface,
    std::uint8_t* __restrict unknown) {
  for (std::size_t i = 0; i < count; ++i) {
    // Points in view are at u, v >= -0.5 but for rounding, which may also lead over the far border:
    // cutting off the fraction is rounding down.
    const int pixel_u = std::clamp(int(u[i] + 0.5f), 0, width - 1);
    const int pixel_v = std::clamp(int(v[i] + 0.5f), 0, height - 1);
    const int pixel = pixel_v * width + pixel_u;
    through[i] = std::uint8_t(depth[i] < front[pixel]);
    surface[i] = std::uint8_t((depth[i] >= front[pixel]) & (depth[i] <= back[pixel]) &
                              (back[pixel] < kBeyondRange));
    unknown[i] = std::uint8_t(front[pixel] == kNothing);
  }
}
constexpr Multiversion<compare_body> compare_kernel;

RowInput row_input(const PinholeCamera& camera, const DepthImage& depth, const GridFrame& frame,
                   const VolumeOptions& options, int v) {
  const Intrinsics& k = camera.intrinsics();
  const Eigen::Matrix3d R = camera.T_world_cam().rotation() / frame.voxel_size_m;
  const Eigen::Vector3d centre = camera.centre() / frame.voxel_size_m;
  const Eigen::Vector3d column = R.col(0) / k.fx;
  const Eigen::Vector3d row = R.col(2) + R.col(1) * ((v - k.cy) / k.fy) - column * k.cx;
  const CellRange voxels = frame.layout.voxels(), blocks = frame.layout.blocks();
  RowInput in{};
  in.depth = depth.metres().data() + std::size_t(v) * std::size_t(depth.width());
  in.width = depth.width();
  in.near_m = float(camera.range().near_m), in.far_m = float(camera.range().far_m);
  in.half_voxel = float(0.5 * frame.voxel_size_m);
  in.noise = float(0.5 * options.band_sigmas * options.noise.sigma_m(1));
  for (int axis = 0; axis < 3; ++axis) {
    in.centre[axis] = centre[axis], in.row[axis] = row[axis], in.column[axis] = column[axis];
    in.size[axis] = voxels.last[axis];
  }
  in.blocks_y = blocks.last.y(), in.blocks_z = blocks.last.z();
  return in;
}

}  // namespace

DepthBands::DepthBands(const PinholeCamera& camera, const DepthImage& depth, const GridFrame& frame,
                       const VolumeOptions& options)
    : width_(depth.width()),
      height_(depth.height()),
      front_(depth.metres().size()),
      back_(front_.size()),
      block_(front_.size()),
      offset_(front_.size()) {
  const int columns = (width_ + kCell - 1) / kCell, rows = (height_ + kCell - 1) / kCell;
  std::vector<float> fronts(std::size_t(columns) * std::size_t(rows)), backs(fronts.size());
  tbb::parallel_for(0, rows, [&](int row) {
    for (int v = row * kCell; v < std::min((row + 1) * kCell, height_); ++v) {
      const RowInput in = row_input(camera, depth, frame, options, v);
      const std::size_t first = std::size_t(v) * std::size_t(width_);
      bands_kernel(in, &front_[first], &back_[first]);
      points_kernel(in, &back_[first], &block_[first], &offset_[first]);
    }
    reduce_row_of_cells(row, fronts, backs);
  });
  fronts_ = MinPyramid(columns, rows, std::move(fronts));
  negative_backs_ = MinPyramid(columns, rows, std::move(backs));
}

void DepthBands::reduce_row_of_cells(int row, std::vector<float>& fronts,
                                     std::vector<float>& backs) const {
  const int columns = (width_ + kCell - 1) / kCell;
  float* const front = &fronts[std::size_t(row) * std::size_t(columns)];
  float* const back = &backs[std::size_t(row) * std::size_t(columns)];
  std::fill_n(front, columns, std::numeric_limits<float>::infinity());
  std::fill_n(back, columns, std::numeric_limits<float>::infinity());
  for (int v = row * kCell; v < std::min((row + 1) * kCell, height_); ++v) {
    const std::size_t first = std::size_t(v) * std::size_t(width_);
    for (int u = 0; u < width_; ++u) {
      front[u / kCell] = std::min(front[u / kCell], front_[first + std::size_t(u)]);
      back[u / kCell] = std::min(back[u / kCell], -back_[first + std::size_t(u)]);
    }
  }
}

PixelRect DepthBands::pixels_of(const ImageRect& rect) const {
  const auto pixel = [](double p, int count) {
    return std::clamp(int(std::floor(p + 0.5)), 0, count - 1);
  };
  return {pixel(rect.u0 - 1, width_), pixel(rect.u1 + 1, width_), pixel(rect.v0 - 1, height_),
          pixel(rect.v1 + 1, height_)};
}

float DepthBands::nearest_front(const PixelRect& p) const {
  return fronts_.min_over(p.u0 / kCell, p.u1 / kCell, p.v0 / kCell, p.v1 / kCell);
}

float DepthBands::farthest_back(const PixelRect& p) const {
  return -negative_backs_.min_over(p.u0 / kCell, p.u1 / kCell, p.v0 / kCell, p.v1 / kCell);
}

void DepthBands::compare(const float* u, const float* v, const float* depth, std::size_t count,
                         std::uint8_t* through, std::uint8_t* surface,
                         std::uint8_t* unknown) const {
  compare_kernel(front_.data(), back_.data(), width_, height_, u, v, depth, count, through, surface,
                 unknown);
}

BlockBits DepthBands::measured_points(std::size_t block, const PixelRect& pixels) const {
  const std::int32_t wanted = std::int32_t(block);
  BlockBits bits;
  for (int v = pixels.v0; v <= pixels.v1; ++v) {
    const std::size_t row = std::size_t(v) * std::size_t(width_);
    for (std::size_t i = row + std::size_t(pixels.u0); i <= row + std::size_t(pixels.u1); ++i) {
      if (block_[i] == wanted) bits.set(offset_[i]);
    }
  }
  return bits;
}

}  // namespace vantage::volume::detail
