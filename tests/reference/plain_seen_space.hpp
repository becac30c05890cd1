#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"

namespace vantage::test {

/// Where a ray first meets what no camera saw through.
struct PlainUnseen {
  struct Source {
    std::uint32_t lattice;
    double facing;
  };
  double t;                     ///< infinite for a miss
  bool at_start;                ///< on a face of the box or, with t = 0, inside
  std::vector<Source> sources;  ///< all that end there: any of them will do
};

/// The slow, obvious twin of UnobservedSpace. The volume of a lattice is a heap of tetrahedra, one
/// from every triangle of its surface to its camera; a ray has an interval in each of them, in
/// double, and the unseen begins where the union of all intervals first has a gap.
class PlainSeenSpace {
 public:
  PlainSeenSpace(std::span<const VisibilityMesh> lattices, const Box& box);

  /// Gaps up to `thinnest` (in t) are none.
  PlainUnseen first_unseen(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                           double t_far, double thinnest) const;

  /// Whether a point is in one of the lattice's tetrahedra.
  bool sees(std::uint32_t lattice, const Eigen::Vector3d& point) const;

 private:
  struct Tetrahedron {
    std::uint32_t lattice;
    /// a · p + w >= 0 inside. The first is the surface, whose normal looks inwards.
    std::array<Eigen::Vector4d, 4> planes;
    Eigen::Vector3d apex;
  };
  struct Interval {
    double enter, leave;
    std::uint32_t lattice;
    double facing;  ///< where it leaves
  };
  void add_triangle(std::uint32_t lattice, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                    const Eigen::Vector3d& c, const Eigen::Vector3d& apex);
  std::vector<Interval> intervals(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const;

  Box box_;
  std::vector<Tetrahedron> tetrahedra_;
};

}  // namespace vantage::test
