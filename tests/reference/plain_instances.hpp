#pragma once

#include <optional>
#include <vector>

#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/pose.hpp"

// The slow, obvious twin of multi-view PnP: every way to divide the measurements of one type among
// objects is tried, and every object is fitted from many starts with numeric derivatives.
namespace vantage::test {

/// A feature as one camera sees it.
struct PlainSighting {
  const Lens* lens = nullptr;
  Pose T_world_cam;
  int view = 0;
  int feature = 0;
  std::vector<Eigen::Vector3d> points_m;  ///< object's frame
  std::vector<Eigen::Vector2d> pixels;
};

struct PlainObject {
  std::vector<std::size_t> measurements;  ///< ascending
  Pose T_world_object;
  double squared_px = 0;
};

/// The pose with the smallest sum of squared residuals, if with it the root mean square of every
/// measurement is within `inlier_px`; and if no feature is there twice in a view. Objects are
/// looked for within 30 cm of the origin.
std::optional<PlainObject> plain_fit(const std::vector<PlainSighting>& all,
                                     const std::vector<std::size_t>& measurements,
                                     double inlier_px);

/// The fewest objects that explain all measurements, of these the ones with the smallest sum of
/// squared residuals; in the order of their first measurements. Up to eight measurements.
std::vector<PlainObject> plain_instances(const std::vector<PlainSighting>& all, double inlier_px);

}  // namespace vantage::test
