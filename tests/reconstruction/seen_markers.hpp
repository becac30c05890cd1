#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pose/pose_fit.hpp"
#include "reconstruction/normal.hpp"
#include "reference/random_scene.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage::test {

inline const Intrinsics kSeenIntrinsics{640, 480, 615, 611, 322.3, 238.1};

/// Without distortion, and with lenses of several kinds.
inline const std::vector<Lens>& some_lenses() {
  static const std::vector<Lens> lenses = {
      {kSeenIntrinsics, {}},
      {kSeenIntrinsics, {0.1, -0.05, 0.001, -0.002, 0.01}},
      {kSeenIntrinsics, {-0.28, 0.09, 0, 0, 0}},
      {kSeenIntrinsics, {0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005}},
      {kSeenIntrinsics, Distortion::fisheye(0.08, -0.02, 0.01, -0.003)}};
  return lenses;
}

inline Eigen::Vector2d normal2(Random& random) {
  const double u = normal(random);
  return {u, normal(random)};
}

inline std::vector<Eigen::Vector3d> marker_corners(double size_m, const Pose& T_object_marker) {
  const auto corners = Marker{"4X4_50", 0, size_m, T_object_marker}.corners();
  return {corners.begin(), corners.end()};
}

/// A marker as a camera sees it, with noise on its corners.
inline reconstruction::detail::PointTerm seen_marker(const Lens& lens, const Pose& T_cam_ref,
                                                     const Pose& T_ref_body,
                                                     std::vector<Eigen::Vector3d> points,
                                                     double sigma_px, Random& random) {
  reconstruction::detail::PointTerm term{
      &lens, T_cam_ref, std::move(points), {}, std::max(sigma_px, 0.1)};
  for (const Eigen::Vector3d& p : term.points_m) {
    const Eigen::Vector2d noise = sigma_px * normal2(random);
    term.pixels.push_back(lens.project(T_cam_ref * (T_ref_body * p)) + noise);
  }
  return term;
}

/// A body with markers of 5 cm within 10 cm, each seen by one of three cameras a metre away.
struct SeenBody {
  Pose T_world_body;
  std::vector<reconstruction::detail::PointTerm> terms;

  SeenBody(Random& random, int markers, double sigma_px) : T_world_body(random.pose(0.3)) {
    const Lens& lens = some_lenses()[random.below(std::uint32_t(some_lenses().size()))];
    std::vector<Pose> cameras;
    while (cameras.size() < 3) {
      const Eigen::Vector3d eye = T_world_body.translation() + random.direction();
      cameras.push_back(Pose::looking_at(eye, T_world_body.translation()).inverse());
    }
    for (int i = 0; i < markers; ++i) {
      const Pose& camera = cameras[std::size_t(i) % cameras.size()];
      terms.push_back(seen_marker(lens, camera, T_world_body,
                                  marker_corners(0.05, random.pose(0.1)), sigma_px, random));
    }
  }

  /// Up to 5 cm and 15° off.
  Pose start(Random& random) const {
    const Eigen::Vector3d turn = 0.26 * random.uniform(0, 1) * random.direction();
    const Eigen::Matrix3d by = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
    return Pose::from_rotation(by * T_world_body.rotation(),
                               T_world_body.translation() + random.in_cube(0.05));
  }
};

/// Metres and the difference of the matrices, added up: zero for equal poses only.
inline double pose_distance(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm() + (a.rotation() - b.rotation()).norm();
}

}  // namespace vantage::test
