#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

namespace vantage::reconstruction::detail {

/// A corner of the simplex around a point: a lattice point, and how much of the point is its.
template <int kDim>
struct LatticeCorner {
  std::array<std::int32_t, kDim> key;
  double weight = 0;  ///< barycentric: of all corners together 1
};

/// Where a point lies in the lattice A*, whose simplices have kDim + 1 corners where a cube has
/// 2^kDim; neighbours are at a distance of 1, corners of one simplex within 1.23 (kDim <= 4).
/// A. Adams, J. Baek, M. Davis, "Fast high-dimensional filtering using the permutohedral lattice",
/// 2010, section 3. The key of -x is the key of x negated.
template <int kDim>
std::array<LatticeCorner<kDim>, kDim + 1> lattice_corners(
    const Eigen::Matrix<double, kDim, 1>& point) {
  constexpr int kN = kDim + 1;
  const double scale = std::sqrt(double(kDim) * kN);
  std::array<double, kN> x{};  // in the plane of sum 0 of R^(kDim + 1): an isometry
  for (int i = 1; i < kN; ++i) {
    const double c = scale * point[i - 1] / std::sqrt(double(i) * (i + 1));
    for (int j = 0; j < i; ++j) x[j] += c;
    x[i] -= i * c;
  }

  std::array<std::int32_t, kN> base{}, rank{};  // the nearest point with multiples of kN
  std::int32_t sum = 0;
  for (int i = 0; i < kN; ++i) {
    base[i] = std::int32_t(std::lround(x[i] / kN)) * kN;
    sum += base[i] / kN;
  }
  for (int i = 0; i < kN; ++i) {
    for (int j = i + 1; j < kN; ++j) ++rank[x[i] - base[i] < x[j] - base[j] ? i : j];
  }
  for (int i = 0; i < kN; ++i) {  // back into the plane, where rounding left it
    rank[i] += sum;
    const std::int32_t turn = rank[i] < 0 ? kN : rank[i] > kDim ? -kN : 0;
    rank[i] += turn;
    base[i] += turn;
  }

  std::array<LatticeCorner<kDim>, kN> corners{};
  std::array<double, kN + 1> weight{};
  for (int i = 0; i < kN; ++i) {
    const double offset = (x[i] - base[i]) / kN;
    weight[kDim - rank[i]] += offset;
    weight[kN - rank[i]] -= offset;
  }
  weight[0] += 1 + weight[kN];
  for (int k = 0; k < kN; ++k) {
    corners[k].weight = std::max(weight[k], 0.0);
    for (int i = 0; i < kDim; ++i) {
      corners[k].key[i] = base[i] + (rank[i] > kDim - k ? k - kN : k);
    }
  }
  return corners;
}

}  // namespace vantage::reconstruction::detail
