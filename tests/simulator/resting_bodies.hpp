#pragma once

#include <Eigen/Core>
#include <vector>

#include "reference/random_scene.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

TriangleMesh cuboid(double x_m, double y_m, double z_m);

/// A convex polygon, counter-clockwise in x and y, from z = -h/2 to h/2.
TriangleMesh prism(const std::vector<Eigen::Vector2d>& profile, double height_m);

/// The prism over a regular polygon with a corner on the x axis.
TriangleMesh rod(double radius_m, double height_m, int sides);

/// A floor plate and a back plate of two boxes.
TriangleMesh bracket(double size_m, double thickness_m);

/// Four walls and a bottom without a lid, of five boxes; the origin is the middle of the bottom.
TriangleMesh open_bin(double side_m, double height_m, double wall_m);

/// The hull of random points within 4 to 10 cm of the origin.
TriangleMesh random_convex_body(Random& random);

}  // namespace vantage::test
