#include "objects/silhouette_map.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace vantage::volume::detail {
namespace {

constexpr int kMaxCells = 320;      ///< along the longer side of the image
constexpr double kTooClose = 1e-3;  ///< metres: edges are cut off at this depth

/// The part of a line parameter's range [0, 1] where a + b t is within [low, high].
bool clip(double a, double b, double low, double high, double& t0, double& t1) {
  if (b == 0) return a >= low && a <= high;
  double enter = (low - a) / b, leave = (high - a) / b;
  if (enter > leave) std::swap(enter, leave);
  t0 = std::max(t0, enter), t1 = std::min(t1, leave);
  return t0 <= t1;
}

double distance_to_origin(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(-a.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (a + t * along).norm();
}

}  // namespace

/// A straight edge in cells; 1 / depth is linear along it.
struct ContourMap::ImageEdge {
  Eigen::Array2d from, step;  ///< at parameter t: from + t · step
  double inverse_from, inverse_step;
  double widen;  ///< cells

  double depth(double t0, double t1) const {
    return 1 / std::max(inverse_from + t0 * inverse_step, inverse_from + t1 * inverse_step);
  }
};

ContourMap::ContourMap(const PinholeCamera& camera)
    : camera_(camera),
      R_cam_world_(camera.T_world_cam().rotation().transpose()),
      cell_px_(std::max(
          1.0, std::ceil(double(std::max(camera.intrinsics().width, camera.intrinsics().height)) /
                         kMaxCells))),
      columns_(int(std::ceil(camera.intrinsics().width / cell_px_))),
      rows_(int(std::ceil(camera.intrinsics().height / cell_px_))),
      nearest_(std::size_t(columns_) * std::size_t(rows_), std::numeric_limits<float>::infinity()) {
}

double ContourMap::lens_radius_m() const {
  const Intrinsics& k = camera_.intrinsics();
  const double u = std::max(std::abs(k.cx), std::abs(k.width - k.cx)) + 1;
  const double v = std::max(std::abs(k.cy), std::abs(k.height - k.cy)) + 1;
  return kTooClose * (1 + u / k.fx + v / k.fy);
}

void ContourMap::add_edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin_m) {
  Eigen::Vector3d a = R_cam_world_ * (from - camera_.centre());
  Eigen::Vector3d b = R_cam_world_ * (to - camera_.centre());
  if (a.z() > b.z()) std::swap(a, b);
  if (a.z() < kTooClose) {
    const double t = (kTooClose - a.z()) / std::max(b.z() - a.z(), kTooClose - a.z());
    const Eigen::Vector3d cut = a + t * (b - a);
    // What is cut off hides something only where it is right before the lens; then it may be
    // anywhere on the image.
    if (distance_to_origin(a, cut) < lens_radius_m()) {
      std::atomic_ref(blocked_lens_).store(1, std::memory_order_relaxed);
    }
    if (b.z() < kTooClose) return;
    a = cut;
  }
  const Intrinsics& k = camera_.intrinsics();
  const auto cell = [&](const Eigen::Vector3d& p) -> Eigen::Array2d {
    return {(k.fx * p.x() / p.z() + k.cx + 0.5) / cell_px_,
            (k.fy * p.y() / p.z() + k.cy + 0.5) / cell_px_};
  };
  const Eigen::Array2d start = cell(a);
  const double widen = 0.01 + margin_m * std::max(k.fx, k.fy) / (a.z() * cell_px_);
  mark({start, cell(b) - start, 1 / a.z(), 1 / b.z() - 1 / a.z(), widen});
}

void ContourMap::mark(const ImageEdge& edge) {
  double t0 = 0, t1 = 1;
  if (!clip(edge.from.x(), edge.step.x(), -edge.widen, columns_ + edge.widen, t0, t1)) return;
  if (!clip(edge.from.y(), edge.step.y(), -edge.widen, rows_ + edge.widen, t0, t1)) return;
  // Along the longer side cell by cell; across it, the cells that the piece touches.
  const int major = std::abs(edge.step.x()) >= std::abs(edge.step.y()) ? 0 : 1, minor = 1 - major;
  const int cells[2] = {columns_, rows_};
  const auto range = [&](int axis, double s0, double s1) {
    const double p = edge.from[axis] + s0 * edge.step[axis];
    const double q = edge.from[axis] + s1 * edge.step[axis];
    return std::pair(std::max(int(std::floor(std::min(p, q) - edge.widen)), 0),
                     std::min(int(std::floor(std::max(p, q) + edge.widen)), cells[axis] - 1));
  };
  const auto [first, last] = range(major, t0, t1);
  for (int m = first; m <= last; ++m) {
    double s0 = t0, s1 = t1;
    if (!clip(edge.from[major], edge.step[major], m - edge.widen, m + 1 + edge.widen, s0, s1)) {
      continue;
    }
    const float depth = float(edge.depth(s0, s1) * (1 - 1e-6));
    const auto [low, high] = range(minor, s0, s1);
    for (int n = low; n <= high; ++n) mark(major == 0 ? m : n, major == 0 ? n : m, depth);
  }
}

void ContourMap::mark(int column, int row, float depth) {
  const std::atomic_ref nearest(
      nearest_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)]);
  float before = nearest.load(std::memory_order_relaxed);
  while (depth < before && !nearest.compare_exchange_weak(before, depth)) {
  }
}

void ContourMap::finish() {
  pyramid_ = MinPyramid(columns_, rows_, std::move(nearest_));
}

bool ContourMap::clear_before(const BoxInView& box) const {
  const auto cell = [&](double pixel, int count) {
    return std::clamp(int(std::floor((pixel + 0.5) / cell_px_)), 0, count - 1);
  };
  const float nearest = pyramid_.min_over(cell(box.rect.u0, columns_), cell(box.rect.u1, columns_),
                                          cell(box.rect.v0, rows_), cell(box.rect.v1, rows_));
  return blocked_lens_ == 0 && double(nearest) > box.z_max;
}

}  // namespace vantage::volume::detail
