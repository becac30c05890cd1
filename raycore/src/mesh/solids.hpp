#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// @throws Error bad_input, `name` as the place, unless the length is positive and finite.
void check_length(double length_m, const std::string& name);

/// The same for each edge of a box.
void check_size(const Eigen::Vector3d& size_m);

/// Corners one after the other, counter-clockwise as seen from where the stack goes to.
using Ring = std::vector<Eigen::Vector3d>;

/// The closed surface that runs from the first ring over all the others to the last. Rings have the
/// same number of corners, or a single one: a tip. A first or last ring that is not a tip is closed
/// by a fan around its first corner, which has to see all the others.
/// @throws Error bad_input, `where` as the place, if floats cannot tell the corners apart.
TriangleMesh ring_stack(const std::vector<Ring>& rings, const std::string& where);

/// A point of a profile that turns around the z axis.
struct ProfilePoint {
  double radius_m = 0;
  double z_m = 0;
};

/// Turns a profile around z. It begins and ends on the axis (radius 0) and has the solid at its
/// left hand.
TriangleMesh turned(const std::vector<ProfilePoint>& profile, int segments,
                    const std::string& where);

}  // namespace vantage::raycore::detail
