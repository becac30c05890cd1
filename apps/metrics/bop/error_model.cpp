#include "metrics/bop/error_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::vector<Pose> turns(const ContinuousSymmetry& symmetry, double max_step) {
  const int count = int(std::ceil(std::numbers::pi / max_step));
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(angle, symmetry.axis.normalized()).toRotationMatrix();
    poses.push_back(
        Pose::from_rotation(rotation, symmetry.offset_m - rotation * symmetry.offset_m));
  }
  return poses;
}

}  // namespace

std::vector<Pose> symmetry_motions(const Symmetries& symmetries, double max_step) {
  std::vector<Pose> discrete{Pose()}, continuous, motions;
  discrete.insert(discrete.end(), symmetries.discrete.begin(), symmetries.discrete.end());
  for (const ContinuousSymmetry& symmetry : symmetries.continuous) {
    const std::vector<Pose> more = turns(symmetry, max_step);
    continuous.insert(continuous.end(), more.begin(), more.end());
  }
  if (continuous.empty()) return discrete;
  for (const Pose& first : discrete) {
    for (const Pose& turn : continuous) motions.push_back(turn * first);
  }
  return motions;
}

double diameter_m(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : vertices) centre += vertex / double(vertices.size());
  std::vector<Eigen::Vector3d> outermost_first = vertices;
  const auto radius = [&](const Eigen::Vector3d& vertex) { return (vertex - centre).norm(); };
  std::ranges::sort(outermost_first, std::greater(), radius);
  double widest = 0;
  for (std::size_t i = 0; i < outermost_first.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Those that follow are nearer to the centre, so none of their pairs can be wider.
      if (radius(outermost_first[i]) + radius(outermost_first[j]) <= widest) {
        if (j == 0) return widest;
        break;
      }
      widest = std::max(widest, (outermost_first[i] - outermost_first[j]).norm());
    }
  }
  return widest;
}

ErrorModel error_model(const TriangleMesh& mesh, const Symmetries& symmetries) {
  if (mesh.vertices().empty()) {
    throw bad_input("mesh", "it has no vertices to measure an error at");
  }
  ErrorModel model{{}, symmetry_motions(symmetries), 0};
  for (const Eigen::Vector3f& vertex : mesh.vertices()) {
    model.vertices.push_back(vertex.cast<double>());
  }
  model.diameter_m = diameter_m(model.vertices);
  return model;
}

}  // namespace vantage
