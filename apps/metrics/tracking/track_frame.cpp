#include "metrics/tracking/track_frame.hpp"

#include <algorithm>

#include "metrics/bop/pose_errors.hpp"
#include "metrics/tracking/assignment.hpp"

namespace vantage {
namespace {

/// From the origin to the farthest vertex.
double reach_of(const ErrorModel& model) {
  double reach = 0;
  for (const Eigen::Vector3d& vertex : model.vertices) reach = std::max(reach, vertex.norm());
  return reach;
}

double nearness_of(const ErrorModel& model, const Pose& estimate, const Pose& truth) {
  return std::max(0.0, 1 - translation_error_m(estimate, truth) / (model.diameter_m / 2));
}

double similarity_of(const TruthAt& truth, const EstimateAt& estimate,
                     std::span<const ErrorModel> models) {
  if (truth.type != estimate.type) return 0;
  const ErrorModel& model = models[truth.type];
  double best = pose_similarity(model, estimate.T_world_object, truth.T_world_object);
  if (truth.judged) return best;
  for (const Pose& pose : truth.excused) {
    best = std::max(best, pose_similarity(model, estimate.T_world_object, pose));
  }
  return best;
}

/// Estimates that stand for objects that are not judged.
std::vector<bool> excused_estimates(const TrackFrame& frame, std::span<const ErrorModel> models) {
  Eigen::MatrixXd all(Eigen::Index(frame.truth.size()), Eigen::Index(frame.estimates.size()));
  for (Eigen::Index t = 0; t < all.rows(); ++t) {
    for (Eigen::Index e = 0; e < all.cols(); ++e) {
      all(t, e) =
          similarity_of(frame.truth[std::size_t(t)], frame.estimates[std::size_t(e)], models);
    }
  }
  std::vector<bool> excused(frame.estimates.size(), false);
  const auto matches = best_assignment(all);
  for (std::size_t t = 0; t < matches.size(); ++t) {
    if (matches[t] && !frame.truth[t].judged) excused[*matches[t]] = true;
  }
  return excused;
}

}  // namespace

double pose_similarity(const ErrorModel& model, const Pose& estimate, const Pose& truth) {
  const double zero_m = model.diameter_m / 2;
  // Symmetries keep every vertex within the reach of its origin.
  if (translation_error_m(estimate, truth) > 2 * reach_of(model) + zero_m) return 0;
  return std::max(0.0, 1 - mssd_m(model, estimate, truth) / zero_m);
}

ComparedFrame compare(const TrackFrame& frame, std::span<const ErrorModel> models) {
  ComparedFrame compared;
  const std::vector<bool> excused = excused_estimates(frame, models);
  for (std::size_t t = 0; t < frame.truth.size(); ++t) {
    if (!frame.truth[t].judged) continue;
    compared.truth.push_back(frame.truth[t].id);
    compared.truth_types.push_back(frame.truth[t].type);
    compared.truth_index.push_back(t);
  }
  for (std::size_t e = 0; e < frame.estimates.size(); ++e) {
    if (excused[e]) continue;
    compared.estimates.push_back(frame.estimates[e].id);
    compared.estimate_index.push_back(e);
  }
  const auto rows = Eigen::Index(compared.truth.size()),
             columns = Eigen::Index(compared.estimates.size());
  compared.similarity.resize(rows, columns);
  compared.nearness.resize(rows, columns);
  for (Eigen::Index t = 0; t < rows; ++t) {
    const TruthAt& truth = frame.truth[compared.truth_index[std::size_t(t)]];
    for (Eigen::Index e = 0; e < columns; ++e) {
      const EstimateAt& estimate = frame.estimates[compared.estimate_index[std::size_t(e)]];
      compared.similarity(t, e) = similarity_of(truth, estimate, models);
      compared.nearness(t, e) =
          nearness_of(models[truth.type], estimate.T_world_object, truth.T_world_object);
    }
  }
  return compared;
}

std::vector<ComparedFrame> compare(std::span<const TrackFrame> frames,
                                   std::span<const ErrorModel> models) {
  std::vector<ComparedFrame> compared;
  for (const TrackFrame& frame : frames) compared.push_back(compare(frame, models));
  return compared;
}

std::vector<std::optional<std::size_t>> matches_of(const ComparedFrame& frame) {
  return best_assignment(frame.similarity);
}

}  // namespace vantage
