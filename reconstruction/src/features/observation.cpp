#include "vantage/reconstruction/observation.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vantage {
namespace {

std::string fault_of_sigma(const char* name, double sigma) {
  if (std::isfinite(sigma) && sigma > 0) return {};
  return fmt::format("{} is {}; expected a positive number", name, sigma);
}

/// Twice the area of the triangle a, b, c; positive if it goes around clockwise on the image.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - b.y()) - (b.y() - a.y()) * (c.x() - b.x());
}

std::string fault_of_corners(const std::vector<Eigen::Vector2d>& corners) {
  if (corners.size() != 4) return fmt::format("a marker with {} corners", corners.size());
  int right = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    right += turn(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]) > 0 ? 1 : 0;
  }
  // Four left turns: convex as well, but a marker has no back.
  if (right == 0) return "the corners are in the wrong order, as if seen from behind";
  if (right != 4) return "the corners do not form a convex quadrilateral";
  const double area =
      (turn(corners[0], corners[1], corners[2]) + turn(corners[2], corners[3], corners[0])) / 2;
  if (area <= 1) return fmt::format("the marker covers only {:.2g} px²", area);
  return {};
}

std::string fault_of_points(const SeenPoints& seen, bool is_marker) {
  const char* what = is_marker ? "corner" : "point";
  if (seen.pixels.empty()) return "there are no points";
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    if (!seen.pixels[i].allFinite()) return fmt::format("{} {} is not finite", what, i);
    for (std::size_t j = 0; j < i; ++j) {
      if (seen.pixels[i] == seen.pixels[j]) {
        return fmt::format("{} {} is the same as {} {}", what, i, what, j);
      }
    }
  }
  if (auto fault = fault_of_sigma("sigma_px", seen.sigma_px); !fault.empty()) return fault;
  return is_marker ? fault_of_corners(seen.pixels) : std::string();
}

std::string fault_of_pose(const SeenPose& seen) {
  auto fault = fault_of_sigma("sigma_m", seen.sigma_m);
  return fault.empty() ? fault_of_sigma("sigma_rad", seen.sigma_rad) : fault;
}

std::string fault_of_label(const SeenLabel& seen) {
  if (!seen.p_cam_m.allFinite()) return "the point is not finite";
  return fault_of_sigma("sigma_m", seen.sigma_m);
}

}  // namespace

std::string fault_of(const Observation& observation) {
  if (const auto* points = std::get_if<SeenPoints>(&observation.data)) {
    return fault_of_points(*points, observation.key.type == "aruco");
  }
  if (const auto* pose = std::get_if<SeenPose>(&observation.data)) return fault_of_pose(*pose);
  return fault_of_label(std::get<SeenLabel>(observation.data));
}

}  // namespace vantage
