#include "hypothesis/canonical_pose.hpp"

#include <algorithm>

#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kSamePointM = 1e-5;

/// The feature that looks the same as the correspondence's and has its points there; none: no such.
std::optional<std::size_t> feature_at(const Correspondence& correspondence,
                                      const Pose& T_there_here) {
  if (correspondence.measurement->pose()) return correspondence.feature->index;
  const std::vector<ObjectFeature>& features = correspondence.type().features;
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (features[f].key != correspondence.measurement->observation->key) continue;
    const std::vector<Eigen::Vector3d> points = features[f].points();
    const bool same =
        std::equal(points.begin(), points.end(), correspondence.points_m.begin(),
                   correspondence.points_m.end(), [&](const auto& there, const auto& here) {
                     return (T_there_here * here - there).norm() < kSamePointM;
                   });
    if (same) return f;
  }
  return std::nullopt;
}

std::optional<CanonicalPose> moved_by_symmetry(const PoseHypothesis& hypothesis,
                                               const Pose& symmetry) {
  CanonicalPose moved{hypothesis.T_world_object * symmetry, {}};
  const Pose back = symmetry.inverse();
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    const auto feature = feature_at(*correspondence, back);
    if (!feature) return std::nullopt;
    moved.features.push_back(*feature);
  }
  return moved;
}

/// Whether no correspondence tells how far the object is turned around the axis.
bool silent(const PoseHypothesis& hypothesis, const ContinuousSymmetry& symmetry) {
  const auto on_axis = [&](const Eigen::Vector3d& point) {
    return symmetry.axis.cross(point - symmetry.offset_m).norm() < kSamePointM;
  };
  return std::all_of(hypothesis.correspondences.begin(), hypothesis.correspondences.end(),
                     [&](const Correspondence* correspondence) {
                       return std::all_of(correspondence->points_m.begin(),
                                          correspondence->points_m.end(), on_axis);
                     });
}

}  // namespace

CanonicalPose canonical_pose(const PoseHypothesis& hypothesis) {
  const ObjectType& type = *hypothesis.type();
  std::optional<CanonicalPose> best;
  const auto consider = [&](std::optional<CanonicalPose> pose) {
    if (!pose) return;
    for (const ContinuousSymmetry& axis : type.symmetries.continuous) {
      if (!silent(hypothesis, axis)) continue;
      pose->T_world_object = turned_towards(axis, pose->T_world_object, Pose());
    }
    const auto closeness = [](const CanonicalPose& p) {
      return p.T_world_object.rotation().trace();
    };
    if (!best || closeness(*pose) > closeness(*best) + 1e-9) best = std::move(pose);
  };
  CanonicalPose as_it_is{hypothesis.T_world_object, {}};
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    as_it_is.features.push_back(correspondence->feature->index);
  }
  consider(std::move(as_it_is));
  for (const Pose& symmetry : type.symmetries.discrete) {
    consider(moved_by_symmetry(hypothesis, symmetry));
  }
  return *best;
}

Matrix6d without_symmetric_turns(const PoseHypothesis& hypothesis, const Matrix6d& information) {
  Matrix6d rest = information;
  for (const ContinuousSymmetry& symmetry : hypothesis.type()->symmetries.continuous) {
    if (!silent(hypothesis, symmetry)) continue;
    const auto along = turn_direction(symmetry, hypothesis.T_world_object);
    const Eigen::Matrix<double, 6, 1> known = rest * along;
    const double amount = along.dot(known);
    if (amount > 0) rest -= known * known.transpose() / amount;
  }
  return rest;
}

}  // namespace vantage::reconstruction::detail
