#include "simulator/sequence/arm.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

constexpr int kSegments = 16;
constexpr double kMinReachM = 0.1;

void append(std::vector<Eigen::Vector3f>& vertices, std::vector<Triangle>& triangles,
            const TriangleMesh& mesh, const Eigen::Vector3d& offset) {
  const auto first = std::uint32_t(vertices.size());
  for (const Eigen::Vector3f& vertex : mesh.vertices()) {
    vertices.push_back(vertex + offset.cast<float>());
  }
  for (const Triangle& t : mesh.triangles()) {
    triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

/// Along z from the origin to `length_m`, with round ends.
TriangleMesh capsule(double radius_m, double length_m) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  append(vertices, triangles, cylinder_solid(radius_m, length_m, kSegments), {0, 0, length_m / 2});
  const TriangleMesh ball = sphere_solid(radius_m, kSegments);
  append(vertices, triangles, ball, Eigen::Vector3d::Zero());
  append(vertices, triangles, ball, {0, 0, length_m});
  return TriangleMesh(std::move(vertices), std::move(triangles), "arm");
}

/// z goes from one point to the other.
Pose along(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Pose::from_quaternion(rotation_between(Eigen::Vector3d::UnitZ(), to - from), from);
}

}  // namespace

Arm::Arm(const Eigen::Vector3d& shoulder, double reach_m)
    : shoulder_(shoulder), link_m_(reach_m / 2) {
  if (!shoulder.allFinite() || !(reach_m > kMinReachM) || !std::isfinite(reach_m)) {
    throw bad_input("arm", fmt::format("found a reach of {} m; expected a finite shoulder and a "
                                       "reach above {} m",
                                       reach_m, kMinReachM));
  }
  link_ = std::make_shared<const TriangleMesh>(capsule(kLinkRadiusM, link_m_));
  gripper_ = std::make_shared<const TriangleMesh>(box_solid({0.05, 0.09, kGripperM}));
}

Eigen::Vector3d Arm::elbow_for(const Eigen::Vector3d& wrist) const {
  const Eigen::Vector3d line = wrist - shoulder_;
  const double half = line.norm() / 2;
  const Eigen::Vector3d direction = line.normalized();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ() - direction.z() * direction;
  if (up.norm() < 1e-6) up = Eigen::Vector3d::UnitX();  // straight up or down: any side will do
  const double rise = std::sqrt(std::max(0.0, link_m_ * link_m_ - half * half));
  return shoulder_ + half * direction + rise * up.normalized();
}

std::vector<ArmPart> Arm::at(const Eigen::Vector3d& tip) const {
  constexpr double kStretch = 0.999;  // a straight arm's elbow has no side
  Eigen::Vector3d wrist = tip + Eigen::Vector3d(0, 0, kGripperM);
  const Eigen::Vector3d line = wrist - shoulder_;
  const double most = kStretch * 2 * link_m_;
  if (line.norm() > most) wrist = shoulder_ + most * line.normalized();
  if ((wrist - shoulder_).norm() < kMinReachM / 10) wrist.z() += kMinReachM;
  const Eigen::Vector3d elbow = elbow_for(wrist);
  return {
      {"upper arm", link_, along(shoulder_, elbow)},
      {"forearm", link_, along(elbow, wrist)},
      {"gripper", gripper_, Pose::from_translation(wrist - Eigen::Vector3d(0, 0, kGripperM / 2))}};
}

Eigen::Vector3d ArmPath::at(double time_s) const {
  if (points.empty()) throw bad_input("arm", "its path has no points; expected one or more");
  const auto after =
      std::ranges::find_if(points, [&](const Point& p) { return p.time_s > time_s; });
  if (after == points.begin()) return points.front().tip;
  if (after == points.end()) return points.back().tip;
  const auto before = after - 1;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return before->tip + share * (after->tip - before->tip);
}

}  // namespace vantage
