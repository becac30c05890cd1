#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mesh/solid_checks.hpp"
#include "mesh/surface_of_revolution.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

/// A profile of (x, z), clockwise where x is to the right and z up, drawn out along y.
TriangleMesh drawn_along_y(const std::vector<Eigen::Vector2d>& profile, double length_m,
                           const std::string& where) {
  detail::Ring front, back;
  for (const Eigen::Vector2d& p : profile) {
    front.emplace_back(p.x(), -length_m / 2, p.y());
    back.emplace_back(p.x(), length_m / 2, p.y());
  }
  return detail::ring_stack({front, back}, where);
}

/// Counter-clockwise from above.
detail::Ring rectangle(double half_x, double half_y, double z) {
  return {{-half_x, -half_y, z}, {half_x, -half_y, z}, {half_x, half_y, z}, {-half_x, half_y, z}};
}

}  // namespace

TriangleMesh box_solid(const Eigen::Vector3d& size_m) {
  detail::check_size(size_m);
  return TriangleMesh::from_box(Box(-0.5 * size_m, 0.5 * size_m, "size_m"));
}

TriangleMesh wedge_solid(const Eigen::Vector3d& size_m) {
  detail::check_size(size_m);
  const double x = size_m.x() / 2, z = size_m.z() / 2;
  return drawn_along_y({{-x, -z}, {x, z}, {x, -z}}, size_m.y(), "wedge");
}

TriangleMesh bracket_solid(const Eigen::Vector3d& size_m, double thickness_m) {
  detail::check_size(size_m);
  detail::check_length(thickness_m, "thickness_m");
  if (thickness_m >= std::min(size_m.x(), size_m.z())) {
    throw bad_input("thickness_m",
                    fmt::format("is {} m; expected less than the bracket's depth of {} m and its "
                                "height of {} m",
                                thickness_m, size_m.x(), size_m.z()));
  }
  const double x = size_m.x() / 2, z = size_m.z() / 2, t = thickness_m;
  // Begins in the corner between the plates, from where one sees all the others.
  return drawn_along_y({{t - x, t - z}, {x, t - z}, {x, -z}, {-x, -z}, {-x, z}, {t - x, z}},
                       size_m.y(), "bracket");
}

TriangleMesh bin_solid(const Eigen::Vector3d& size_m, double wall_m) {
  detail::check_size(size_m);
  detail::check_length(wall_m, "wall_m");
  if (2 * wall_m >= std::min(size_m.x(), size_m.y()) || wall_m >= size_m.z()) {
    throw bad_input("wall_m", fmt::format("is {} m; expected less than half of the bin's length "
                                          "and width ({} m, {} m) and less than its height of {} m",
                                          wall_m, size_m.x(), size_m.y(), size_m.z()));
  }
  const double x = size_m.x() / 2, y = size_m.y() / 2, z = size_m.z() / 2;
  return detail::ring_stack(
      {rectangle(x, y, -z), rectangle(x, y, z), rectangle(x - wall_m, y - wall_m, z),
       rectangle(x - wall_m, y - wall_m, wall_m - z)},
      "bin");
}

}  // namespace vantage
