#include "voting/label_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kSameMarker = 0.85;  // sizes: beyond it, there is room for another one

/// The standard deviation of a point of an object along the direction in which it is largest.
double sigma_of(const Vote& vote, const Eigen::Vector3d& p_object) {
  const Eigen::Vector3d arm = vote.T_world_object.rotation() * p_object;
  Eigen::Matrix<double, 3, 6> move;
  move << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
  move.rightCols<3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  return std::sqrt((move * vote.covariance * move.transpose()).trace());
}

const Marker* marker_of(const TypeFeature& feature) {
  return std::get_if<Marker>(&feature.type->features[feature.index].geometry);
}

bool near_any(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& p, double reach) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& point) { return (point - p).norm() <= reach; });
}

}  // namespace

LabelEvidence::LabelEvidence(const CandidateCorrespondences& candidates,
                             const std::vector<Vote>& votes)
    : candidates_(&candidates) {
  std::vector<bool> placed(candidates.measurements.size(), false);
  for (const Vote& vote : votes) {
    const Correspondence& correspondence = *vote.correspondences.front();
    const Marker* marker = marker_of(*correspondence.feature);
    if (!marker || placed[correspondence.number]) continue;
    placed[correspondence.number] = true;
    const Eigen::Vector3d& p = marker->T_object_marker.translation();
    label_evidence_.push_back({correspondence.number, vote.T_world_object * p, sigma_of(vote, p)});
  }
  for (std::size_t i = 0; i < candidates.measurements.size(); ++i) {
    const Measurement& measurement = candidates.measurements[i];
    for (const TypeFeature* feature : measurement.features) {
      auto& body = bodies_[feature->type.get()];
      if (!body) body = std::make_unique<TypeBody>(*feature->type);
    }
    if (const SeenLabel* label = measurement.label()) {
      label_evidence_.push_back(
          {i, *measurement.view->T_world_cam * label->p_cam_m, label->sigma_m});
    }
  }
  sort();
}

void LabelEvidence::sort() {
  std::stable_sort(
      label_evidence_.begin(), label_evidence_.end(),
      [](const SeenFeature& a, const SeenFeature& b) { return a.p_world.x() < b.p_world.x(); });
}

void LabelEvidence::place(const std::vector<const Correspondence*>& correspondences,
                          const Pose& T_world_object) {
  for (SeenFeature& witness : label_evidence_) {
    const auto correspondence =
        std::find_if(correspondences.begin(), correspondences.end(),
                     [&](const Correspondence* other) { return other->number == witness.number; });
    if (correspondence == correspondences.end()) continue;
    const Marker* marker = marker_of(*(*correspondence)->feature);
    if (!marker) continue;
    witness.p_world = T_world_object * marker->T_object_marker.translation();
    witness.sigma_m = 0;
  }
  sort();
}

const TypeFeature* LabelEvidence::carried(const SeenFeature& witness, const ObjectType& type,
                                          const Pose& T_world_object, double tolerance_m) const {
  const Measurement& measurement = candidates_->measurements[witness.number];
  const Pose T_object_world = T_world_object.inverse();
  const Eigen::Vector3d p = T_object_world * witness.p_world;
  for (const TypeFeature* feature : measurement.features) {
    if (feature->type.get() != &type) continue;
    if (const Marker* marker = marker_of(*feature)) {
      const double distance = (marker->T_object_marker.translation() - p).norm();
      if (distance <= std::min(0.5 * marker->size_m + tolerance_m, kSameMarker * marker->size_m)) {
        return feature;
      }
      continue;
    }
    const auto* label = std::get_if<FeatureLabel>(&type.features[feature->index].geometry);
    if (!label) continue;
    if (near_any(label->points_m, p, label->radius_m + tolerance_m)) return feature;
    if (!label->points_m.empty()) continue;
    const auto depth =
        body(type).depth_behind(T_object_world * measurement.view->T_world_cam->translation(), p);
    if (depth && std::abs(*depth) <= tolerance_m) return feature;
  }
  return nullptr;
}

LabelVotes LabelEvidence::label_votes(const ObjectType& type, const Pose& T_world_object,
                                      double slack_m, const std::vector<bool>& free) const {
  const TypeBody& shape = body(type);
  const Pose T_object_world = T_world_object.inverse();
  const Eigen::Vector3d centre = T_world_object * shape.centre();
  const double reach = shape.radius_m() + slack_m;
  const auto from = std::lower_bound(
      label_evidence_.begin(), label_evidence_.end(), centre.x() - reach,
      [](const SeenFeature& witness, double x) { return witness.p_world.x() < x; });
  LabelVotes label_votes;
  for (auto witness = from; witness != label_evidence_.end(); ++witness) {
    if (witness->p_world.x() > centre.x() + reach) break;
    if ((witness->p_world - centre).norm() > reach) continue;
    const double tolerance = slack_m + witness->sigma_m;
    const Measurement& measurement = candidates_->measurements[witness->number];
    if (const TypeFeature* feature = carried(*witness, type, T_world_object, tolerance)) {
      if (measurement.label() && free[witness->number]) {
        label_votes.labels.emplace_back(witness->number, feature->index);
      }
      continue;
    }
    const Eigen::Vector3d eye = T_object_world * measurement.view->T_world_cam->translation();
    const auto depth = shape.depth_behind(eye, T_object_world * witness->p_world);
    if (depth && *depth <= tolerance) ++label_votes.against;
  }
  std::sort(label_votes.labels.begin(), label_votes.labels.end());
  return label_votes;
}

}  // namespace vantage::reconstruction::detail
