#include "unobserved/lattice_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::raycore::detail {
namespace {

/// A bucket is at most as wide as the narrowest cell, within reason.
int bucket_count(const std::vector<float>& lines) {
  constexpr double kMaxBuckets = 1 << 14;
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    narrowest = std::min(narrowest, double(lines[i]) - double(lines[i - 1]));
  }
  const double range = double(lines.back()) - double(lines.front());
  return int(std::clamp(std::ceil(range / narrowest), 1.0, kMaxBuckets));
}

}  // namespace

AxisLookup::AxisLookup(const std::vector<float>& lines)
    : first(lines.front()), last(lines.back()), starts(lines), inverse_width(lines.size() - 1) {
  const int buckets = bucket_count(lines);
  last_bucket = buckets - 1;
  buckets_per_pixel = std::min(float(buckets) / (last - first), 1e30f);
  const auto cells = int(inverse_width.size());
  for (int i = 0; i < cells; ++i)
    inverse_width[std::size_t(i)] = 1 / (lines[std::size_t(i) + 1] - lines[std::size_t(i)]);
  starts.back() = std::numeric_limits<float>::infinity();

  step = lines[1] - lines[0];
  even = true;
  for (int i = 0; i < cells; ++i) even = even && lines[std::size_t(i)] == first + float(i) * step;

  // Line i is found by the same arithmetic as every coordinate, so that no coordinate behind it
  // comes into a bucket before it.
  cell_of_bucket.assign(std::size_t(buckets), 0);
  std::vector<int> cells_begun(std::size_t(buckets), 0);
  for (int i = 1; i < cells; ++i) {
    const int bucket =
        std::min(int((lines[std::size_t(i)] - first) * buckets_per_pixel), last_bucket);
    ++cells_begun[std::size_t(bucket)];
  }
  int cell = 0;
  for (std::size_t bucket = 0; bucket < cells_begun.size(); ++bucket) {
    cell_of_bucket[bucket] = cell;
    cell += cells_begun[bucket];
  }
  steps = *std::max_element(cells_begun.begin(), cells_begun.end());
}

LatticeProbe::LatticeProbe(const VisibilityMesh& lattice)
    : columns(lattice.columns),
      rows(lattice.rows),
      width(int(lattice.width())),
      nearness(lattice.depth.size()) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float smallest = kInfinity;
  for (const float depth : lattice.depth) smallest = depth < smallest ? depth : smallest;
  nearest = smallest < kInfinity ? smallest : 1;
  height = kHighest * nearest;
  for (std::size_t i = 0; i < nearness.size(); ++i) nearness[i] = height / lattice.depth[i];
  const Intrinsics& k = lattice.camera.intrinsics();
  Eigen::Matrix3d K;
  K << k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1;
  pixels_from_world = K * lattice.camera.T_world_cam().rotation().transpose();
}

ProbeView::ProbeView(const LatticeProbe& lattice_probe, const Eigen::Vector3d& relative_origin)
    : probe(&lattice_probe) {
  const Eigen::Matrix3d& M = lattice_probe.pixels_from_world;
  const Eigen::Vector3d o = M * relative_origin;
  for (int row = 0; row < 3; ++row) {
    origin[row] = float(o[row]);
    for (int col = 0; col < 3; ++col) m[3 * row + col] = float(M(row, col));
  }
  const AxisLookup &columns = lattice_probe.columns, &rows = lattice_probe.rows;
  borders[0] = float(o.x() - double(columns.first) * o.z());
  borders[1] = float(double(columns.last) * o.z() - o.x());
  borders[2] = float(o.y() - double(rows.first) * o.z());
  borders[3] = float(double(rows.last) * o.z() - o.y());
}

}  // namespace vantage::raycore::detail
