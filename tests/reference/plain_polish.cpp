#include "reference/plain_polish.hpp"

#include <cmath>
#include <numbers>

namespace vantage::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A camera's frame in spherical coordinates around the middle: outwards, east, north.
Eigen::Matrix3d frame_at(double azimuth, double elevation) {
  Eigen::Matrix3d frame;
  frame.col(0) << std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
      std::sin(elevation);
  frame.col(1) << -std::sin(azimuth), std::cos(azimuth), 0;
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

Eigen::Matrix3d turned_about(int axis, double angle) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  turn(a, a) = turn(b, b) = std::cos(angle);
  turn(b, a) = std::sin(angle);
  turn(a, b) = -std::sin(angle);
  return turn;
}

}  // namespace

std::optional<Pose> plain_polished_pose(const Pose& start, const Eigen::Vector3d& middle,
                                        const PolishAngles& angles) {
  const Eigen::Vector3d arm = start.translation() - middle;
  const double distance_m = arm.norm(), elevation = std::asin(arm.z() / distance_m);
  if (elevation + angles[1] > std::numbers::pi / 2 + 1e-9) return std::nullopt;
  double azimuth = std::atan2(arm.y(), arm.x());
  if (std::hypot(arm.x(), arm.y()) < 1e-6 * distance_m) {
    // Straight above: down is where the image's lower border is.
    const Eigen::Vector3d right = start.rotation().col(0);
    azimuth = std::atan2(-right.x(), right.y());
  }
  const Eigen::Matrix3d here = frame_at(azimuth, elevation);
  const Eigen::Matrix3d there = frame_at(azimuth + angles[0], elevation + angles[1]);
  const Eigen::Matrix3d rotation = there * here.transpose() * start.rotation() *
                                   turned_about(1, angles[2]) * turned_about(0, angles[3]);
  return Pose::from_rotation(rotation, middle + distance_m * there.col(0));
}

std::vector<std::pair<int, double>> plain_polish(
    const Pose& start, const Eigen::Vector3d& middle,
    const std::function<std::uint64_t(const Pose&)>& worth) {
  std::vector<std::pair<int, double>> steps;
  PolishAngles here{};
  std::uint64_t best = worth(start);
  for (const double part : {1.0, 0.5, 0.25}) {
    std::size_t before;
    do {
      before = steps.size();
      for (int move = 0; move < 4; ++move) {
        for (const double sign : {1.0, -1.0}) {
          const double by = sign * part * (move < 2 ? 20 : 6) * kDegree;
          PolishAngles next = here;
          next[std::size_t(move)] += by;
          const auto pose = plain_polished_pose(start, middle, next);
          if (!pose || worth(*pose) <= best) continue;
          here = next, best = worth(*pose);
          steps.push_back({move, by});
          break;
        }
      }
    } while (steps.size() > before);
  }
  return steps;
}

}  // namespace vantage::test
