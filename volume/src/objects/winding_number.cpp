#include "objects/winding_number.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace vantage::volume::detail {
namespace {

constexpr std::size_t kLeafTriangles = 8;
/// How many radii a point has to be away for a node to stand for its triangles (Barill's beta).
constexpr double kFar = 2.3;

using Corners = std::array<Eigen::Vector3d, 3>;

Corners corners_of(const Triangle& triangle, std::span<const Eigen::Vector3f> v) {
  return {v[triangle[0]].cast<double>(), v[triangle[1]].cast<double>(),
          v[triangle[2]].cast<double>()};
}

/// Twice the area vector.
Eigen::Vector3d doubled_area(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

/// Half the solid angle of a triangle (Van Oosterom and Strackee, 1983), positive from behind it.
double half_solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return std::atan2(a.dot(b.cross(c)),
                    la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

WindingNumber::WindingNumber(std::span<const Eigen::Vector3f> vertices,
                             std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  nodes_.reserve(triangles.size() / 2 + 1);
  if (!order.empty()) build(order, 0, vertices, triangles);
  corners_.reserve(3 * triangles.size());
  for (const std::uint32_t t : order) {
    for (const Eigen::Vector3d& corner : corners_of(triangles[t], vertices)) {
      corners_.push_back(corner);
    }
  }
}

WindingNumber::Node WindingNumber::summed(std::span<const std::uint32_t> order,
                                          std::span<const Eigen::Vector3f> v,
                                          std::span<const Triangle> triangles) const {
  Node node = {};
  double weight = 0;
  for (const std::uint32_t t : order) {
    const Corners c = corners_of(triangles[t], v);
    const Eigen::Vector3d area = doubled_area(c);
    node.area += 0.5 * area;
    node.centre += area.norm() * (c[0] + c[1] + c[2]) / 3;
    weight += area.norm();
  }
  node.centre =
      weight > 0 ? Eigen::Vector3d(node.centre / weight) : corners_of(triangles[order[0]], v)[0];
  node.moment.setZero();
  for (const std::uint32_t t : order) {
    const Corners c = corners_of(triangles[t], v);
    const Eigen::Vector3d from_centre = (c[0] + c[1] + c[2]) / 3 - node.centre;
    node.moment += 0.5 * from_centre * doubled_area(c).transpose();
    for (const Eigen::Vector3d& corner : c) {
      node.radius = std::max(node.radius, (corner - node.centre).norm());
    }
  }
  return node;
}

/// Halves the triangles at the median along the longest side of their centres' box. The depth is
/// the logarithm of their number.
void WindingNumber::build(std::span<std::uint32_t> order, std::uint32_t first,
                          std::span<const Eigen::Vector3f> v, std::span<const Triangle> triangles) {
  const std::size_t index = nodes_.size();
  nodes_.push_back(summed(order, v, triangles));
  nodes_[index].first = first;
  nodes_[index].last = first + std::uint32_t(order.size());
  nodes_[index].leaf = order.size() <= kLeafTriangles;
  if (!nodes_[index].leaf) {
    const auto middle_of = [&](std::uint32_t t) -> Eigen::Vector3f {
      return v[triangles[t][0]] + v[triangles[t][1]] + v[triangles[t][2]];
    };
    Eigen::AlignedBox3f box;
    for (const std::uint32_t t : order) box.extend(middle_of(t));
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(half), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const float at_a = middle_of(a)[axis], at_b = middle_of(b)[axis];
                       return at_a != at_b ? at_a < at_b : a < b;
                     });
    build(order.first(half), first, v, triangles);
    build(order.subspan(half), first + std::uint32_t(half), v, triangles);
  }
  nodes_[index].skip = std::uint32_t(nodes_.size());
}

double WindingNumber::at(const Eigen::Vector3d& point) const {
  double sum = 0;  // of half solid angles
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    const Eigen::Vector3d r = node.centre - point;
    const double distance = r.norm();
    if (distance > kFar * node.radius) {
      // Barill et al., eq. 13 to the first order of the Taylor series.
      const double inverse = 1 / distance, cubed = inverse * inverse * inverse;
      const double spread = node.moment.trace() - 3 * r.dot(node.moment * r) * inverse * inverse;
      sum += 0.5 * cubed * (node.area.dot(r) + spread);
      i = node.skip;
    } else if (node.leaf) {
      for (std::uint32_t t = node.first; t < node.last; ++t) {
        sum += half_solid_angle(corners_[3 * t] - point, corners_[3 * t + 1] - point,
                                corners_[3 * t + 2] - point);
      }
      i = node.skip;
    } else {
      ++i;
    }
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace vantage::volume::detail
