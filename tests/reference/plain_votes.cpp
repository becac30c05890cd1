#include "reference/plain_votes.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::test {
namespace {

/// The basis of the plane of sum 0 in which the lattice has its points: column i.
template <int kDim>
Eigen::Matrix<double, kDim + 1, kDim> basis() {
  Eigen::Matrix<double, kDim + 1, kDim> columns;
  columns.setZero();
  for (int i = 0; i < kDim; ++i) {
    columns.col(i).head(i + 1).setOnes();
    columns(i + 1, i) = -(i + 1);
    columns.col(i).normalize();
  }
  return columns;
}

template <int kDim>
double hat(const Eigen::Matrix<double, kDim, 1>& offset) {
  const double neighbour = std::sqrt(double(kDim) / (kDim + 1));  // (1, ..., 1, -d) / (d + 1)
  const auto x = (basis<kDim>() * offset * neighbour).eval();
  return std::max(0.0, 1 - (x.maxCoeff() - x.minCoeff()));
}

}  // namespace

double hat3(const Eigen::Vector3d& offset) {
  return hat<3>(offset);
}

double hat4(const Eigen::Vector4d& offset) {
  return hat<4>(offset);
}

PlainCells shares_in_space(const Eigen::Vector3d& point) {
  // Lattice points are (n + k) / 4 with whole n and the same k for all, in the plane of sum 0.
  const Eigen::Matrix<double, 3, 4> to_space = basis<3>().transpose();
  const double neighbour = std::sqrt(3.0 / 4);
  const int reach = int(std::ceil(point.norm())) + 2;
  PlainCells cells;
  for (int a = -reach; a <= reach; ++a) {
    for (int b = -reach; b <= reach; ++b) {
      for (int c = -reach; c <= reach; ++c) {
        for (int k = 0; k < 4; ++k) {
          Eigen::Vector4d x(4 * a + k, 4 * b + k, 4 * c + k, 0);
          x[3] = -x.head<3>().sum();
          const double share = hat3(point - to_space * x / 4 / neighbour);
          if (share > 0) cells[{int(x[0]), int(x[1]), int(x[2]), int(x[3])}] = share;
        }
      }
    }
  }
  return cells;
}

double density(const std::vector<PlainPlace>& votes, const PlainPlace& at, double width_cells) {
  double sum = 0;
  for (const PlainPlace& vote : votes) {
    if (vote.type != at.type) continue;
    const double turn =
        std::min((vote.turn - at.turn).squaredNorm(), (vote.turn + at.turn).squaredNorm());
    const double squared = (vote.position - at.position).squaredNorm() + turn;
    sum += std::exp(-0.5 * squared / (width_cells * width_cells));
  }
  return sum;
}

}  // namespace vantage::test
