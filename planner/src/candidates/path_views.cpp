#include "candidates/path_views.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage::detail {
namespace {

Pose interpolated(const Pose& from, const Pose& to, double share) {
  return Pose::from_quaternion(
      from.quaternion().slerp(share, to.quaternion()),
      from.translation() + share * (to.translation() - from.translation()));
}

double way_between(const Pose& from, const Pose& to) {
  return (to.translation() - from.translation()).norm();
}

double length_of(const std::vector<Pose>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += way_between(path[i - 1], path[i]);
  return length;
}

}  // namespace

std::vector<Pose> poses_along(const std::vector<Pose>& path, double step_m, std::int64_t most) {
  if (path.empty()) throw bad_input("candidates", "the path has no poses; expected at least one");
  const double length = length_of(path);
  if (!(length / step_m <= double(most))) {
    throw bad_input("candidates",
                    fmt::format("a step of {} m on a path of {:.6g} m gives {:.3g} places; at most "
                                "{} views are handled: use longer steps",
                                step_m, length, length / step_m, most));
  }
  std::vector<Pose> poses = {path.front()};
  double done = 0;  // the way to the segment's begin
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double way = way_between(path[i - 1], path[i]);
    // Multiples of the step instead of sums: no rounding adds up. What is on the path's end but for
    // rounding is its end.
    while (double(poses.size()) * step_m <= done + way &&
           double(poses.size()) * step_m < length * (1 - 1e-9)) {
      const double share = (double(poses.size()) * step_m - done) / way;
      poses.push_back(interpolated(path[i - 1], path[i], share));
    }
    done += way;
  }
  if (path.size() > 1) poses.push_back(path.back());
  return poses;
}

}  // namespace vantage::detail
