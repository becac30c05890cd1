#pragma once

#include <array>
#include <optional>
#include <vector>

#include "support/contacts.hpp"

namespace vantage::reconstruction::detail {

/// A triangle of a body, world frame.
struct FacingTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3d normal;
  Eigen::AlignedBox3d bounds;
};

/// Gaps between which two triangles touch.
struct GapLimits {
  double deepest_m = 0;    ///< not negative: an overlap by more is no contact
  double widest_m = 0;     ///< a gap by more is none
  double flat_cosine = 1;  ///< faces that oppose each other by more lie flat
};

/// Adds corners of the area in which two triangles that face each other touch: projected along the
/// middle of their normals, one is cut by the other.
void add_contacts(const FacingTriangle& upper, const FacingTriangle& lower, const GapLimits& limits,
                  std::vector<ContactPoint>& points);

}  // namespace vantage::reconstruction::detail
