#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::volume::detail {

/// The generalized winding number of a mesh (Jacobson et al., "Robust inside-outside segmentation
/// using generalized winding numbers", 2013): 1 inside a closed mesh that looks outwards, 0
/// outside, and something between where the mesh has holes. Triangles far from a point are taken
/// together (Barill et al., "Fast winding numbers for soups and clouds", 2018): their area vectors,
/// and how those are spread to the second order, in place of their solid angles. Off by less than
/// 0.01. Immutable; thread-safe.
class WindingNumber {
 public:
  WindingNumber(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles);

  double at(const Eigen::Vector3d& point) const;

 private:
  /// A box of triangles; its children follow it, or it is a leaf.
  struct Node {
    Eigen::Vector3d centre;  ///< weighted by area
    double radius;           ///< of the ball around it that holds all corners
    Eigen::Vector3d area;    ///< the sum of the area vectors
    Eigen::Matrix3d moment;  ///< the sum of (triangle's centre - centre) times area vector
    /// The second moments, area vector times offset times offset: what of them counts.
    Eigen::Vector3d contraction;
    Eigen::Matrix<double, 10, 1> cubic;  ///< coefficients of xxx, xxy, xxz, xyy, xyz, xzz, yyy …
    std::uint32_t first, last;           ///< of `corners_`, in triangles
    std::uint32_t skip;                  ///< the node that comes after its children
    bool leaf;
  };

  void build(std::span<std::uint32_t> order, std::uint32_t first,
             std::span<const Eigen::Vector3f> v, std::span<const Triangle> triangles);
  Node summed(std::span<const std::uint32_t> order, std::span<const Eigen::Vector3f> v,
              std::span<const Triangle> triangles) const;

  std::vector<Node> nodes_;
  std::vector<Eigen::Vector3d> corners_;  // three for each triangle, leaf by leaf
};

}  // namespace vantage::volume::detail
