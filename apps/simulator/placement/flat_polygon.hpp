#pragma once

#include <Eigen/Core>
#include <vector>

namespace vantage {

/// A convex polygon in a plane, counter-clockwise.
using FlatPolygon = std::vector<Eigen::Vector2d>;

/// The convex hull of points (Andrew's monotone chain, 1979). Fewer than three points for a line.
FlatPolygon hull_of(std::vector<Eigen::Vector2d> points);

/// What two polygons have in common; empty if nothing.
FlatPolygon common_part(const FlatPolygon& a, const FlatPolygon& b);

double area_of(const FlatPolygon& polygon);

/// How far inside the polygon a point lies; negative outside of it: then it is the distance to the
/// line of the worst edge, the true distance at most. Of no polygon: minus infinity.
double depth_inside(const FlatPolygon& polygon, const Eigen::Vector2d& point);

}  // namespace vantage
