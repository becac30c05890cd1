#include "objects/winding_number.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::volume::detail {
namespace {

constexpr std::size_t kLeafTriangles = 8;
/// How many radii a point has to be away for a node to stand for its triangles (Barill's beta).
constexpr double kFar = 2.3;

using raycore::detail::half_solid_angle;

using Corners = std::array<Eigen::Vector3d, 3>;

Corners corners_of(const Triangle& triangle, std::span<const Eigen::Vector3f> v) {
  return {v[triangle[0]].cast<double>(), v[triangle[1]].cast<double>(),
          v[triangle[2]].cast<double>()};
}

/// Twice the area vector.
Eigen::Vector3d doubled_area(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

/// The products of three coordinates that a cubic form is made of, in the order of `Node::cubic`.
Eigen::Matrix<double, 10, 1> cubic_products(const Eigen::Vector3d& r) {
  const double x = r.x(), y = r.y(), z = r.z();
  Eigen::Matrix<double, 10, 1> products;
  products << x * x * x, x * x * y, x * x * z, x * y * y, x * y * z, x * z * z, y * y * y,
      y * y * z, y * z * z, z * z * z;
  return products;
}

/// The mean of offset times offset over a triangle, from a point.
Eigen::Matrix3d second_moment(const Corners& c, const Eigen::Vector3d& from) {
  const Eigen::Vector3d middle = (c[0] + c[1] + c[2]) / 3;
  Eigen::Matrix3d moment = (middle - from) * (middle - from).transpose();
  for (const Eigen::Vector3d& corner : c) {
    moment += (corner - middle) * (corner - middle).transpose() / 12;
  }
  return moment;
}

/// The cubic form of area vector times a symmetric matrix.
Eigen::Matrix<double, 10, 1> cubic_form(const Eigen::Vector3d& a, const Eigen::Matrix3d& m) {
  Eigen::Matrix<double, 10, 1> form;
  form << a.x() * m(0, 0), a.y() * m(0, 0) + 2 * a.x() * m(0, 1),
      a.z() * m(0, 0) + 2 * a.x() * m(0, 2), a.x() * m(1, 1) + 2 * a.y() * m(0, 1),
      2 * (a.x() * m(1, 2) + a.y() * m(0, 2) + a.z() * m(0, 1)),
      a.x() * m(2, 2) + 2 * a.z() * m(0, 2), a.y() * m(1, 1), a.z() * m(1, 1) + 2 * a.y() * m(1, 2),
      a.y() * m(2, 2) + 2 * a.z() * m(1, 2), a.z() * m(2, 2);
  return form;
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
  node.contraction.setZero();
  node.cubic.setZero();
  for (const std::uint32_t t : order) {
    const Corners c = corners_of(triangles[t], v);
    const Eigen::Vector3d from_centre = (c[0] + c[1] + c[2]) / 3 - node.centre;
    const Eigen::Vector3d area = 0.5 * doubled_area(c);
    const Eigen::Matrix3d second = second_moment(c, node.centre);
    node.moment += from_centre * area.transpose();
    node.contraction += 2 * second * area + second.trace() * area;
    node.cubic += cubic_form(area, second);
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
      // Barill et al., section 3: the Taylor series of the solid angle to its second order.
      const double inverse2 = 1 / (distance * distance), inverse3 = inverse2 / distance;
      const double first = node.moment.trace() - 3 * r.dot(node.moment * r) * inverse2;
      const double second = 7.5 * node.cubic.dot(cubic_products(r)) * inverse2 * inverse2 -
                            1.5 * node.contraction.dot(r) * inverse2;
      sum += 0.5 * inverse3 * (node.area.dot(r) + first + second);
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
