#include "metrics/reconstruction/reconstruction_evaluator.hpp"

#include <fmt/format.h>

#include "metrics/bop/pose_errors.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::vector<double> scores_of(const Reconstruction& reconstruction) {
  std::vector<double> scores;
  for (const ReconstructedObject& object : reconstruction.objects) {
    scores.push_back(object.probability);
  }
  return scores;
}

}  // namespace

ReconstructionEvaluator::ReconstructionEvaluator(std::vector<TrueObject> truth, double correct)
    : truth_(std::move(truth)), correct_(correct) {
  if (!(correct > 0)) {
    throw bad_input("correct",
                    fmt::format("found {}; expected a share of the diameter above 0", correct));
  }
  std::vector<PlacedModel> placed;
  for (const TrueObject& object : truth_) {
    const auto& [name, mesh] = std::tie(object.type->name, *object.type->mesh);
    if (!by_type_.contains(name)) {
      by_type_.emplace(name, error_model(mesh, object.type->symmetries));
    }
    models_.push_back(&by_type_.at(name));
    placed.push_back({models_.back(), object.T_world_object});
  }
  touching_ = touching_corners(placed);
}

Eigen::MatrixXd ReconstructionEvaluator::errors_of(const Reconstruction& reconstruction) const {
  const auto& estimates = reconstruction.objects;
  Eigen::MatrixXd errors(Eigen::Index(estimates.size()), Eigen::Index(truth_.size()));
  errors.setConstant(kInfinite);
  for (std::size_t e = 0; e < estimates.size(); ++e) {
    for (std::size_t t = 0; t < truth_.size(); ++t) {
      if (estimates[e].type->name != truth_[t].type->name) continue;
      const ErrorModel& model = *models_[t];
      errors(Eigen::Index(e), Eigen::Index(t)) =
          mssd_m(model, estimates[e].T_world_object, truth_[t].T_world_object) / model.diameter_m;
    }
  }
  return errors;
}

std::vector<std::optional<Match>> ReconstructionEvaluator::matches(
    const Reconstruction& reconstruction) const {
  return match_instances(errors_of(reconstruction), scores_of(reconstruction), kInfinite);
}

ReconstructionScore ReconstructionEvaluator::evaluator(const Reconstruction& reconstruction,
                                                       const std::vector<bool>& counts) const {
  const Eigen::MatrixXd errors = errors_of(reconstruction);
  const std::vector<double> scores = scores_of(reconstruction);
  const auto correct = match_instances(errors, scores, correct_);
  ReconstructionScore score{std::size_t(std::count(counts.begin(), counts.end(), true)),
                            scores.size(), found(correct, counts),
                            found(correct, std::vector(truth_.size(), true))};
  for (const double threshold : bop_thresholds()) {
    score.found_at.push_back(found(match_instances(errors, scores, threshold), counts));
  }
  const auto matches = match_instances(errors, scores, kInfinite);
  for (std::size_t e = 0; e < matches.size(); ++e) {
    if (!matches[e]) continue;
    const std::size_t t = matches[e]->truth;
    const Pose& estimate = reconstruction.objects[e].T_world_object;
    const auto nearest = nearest_symmetric(*models_[t], estimate, truth_[t].T_world_object);
    score.objects.push_back({e, t, translation_error_m(estimate, nearest.T_ref_object),
                             rotation_error_rad(estimate, nearest.T_ref_object), nearest.mssd_m});
  }
  score.self_consistency_mm2 = self_consistency_mm2(reconstruction, score.objects);
  return score;
}

std::optional<double> ReconstructionEvaluator::self_consistency_mm2(
    const Reconstruction& reconstruction, const std::vector<ObjectErrors>& objects) const {
  if (touching_.empty()) return {};
  std::vector<std::optional<Pose>> found(truth_.size());
  for (const ObjectErrors& object : objects) {
    const Pose& estimate = reconstruction.objects[object.estimate].T_world_object;
    const Pose& truth = truth_[object.truth].T_world_object;
    const auto nearest = nearest_symmetric(*models_[object.truth], estimate, truth);
    // As the symmetry has turned the truth to the estimate, it turns the estimate back.
    found[object.truth] = estimate * nearest.T_ref_object.inverse() * truth;
  }
  std::vector<Pose> poses;
  for (const auto& pose : found) poses.push_back(pose.value_or(Pose()));
  for (const TouchingCorners& pair : touching_) {
    if (!found[pair.object_a] || !found[pair.object_b]) return {};
  }
  return vantage::self_consistency_mm2(touching_, poses);
}

}  // namespace vantage
