#include <algorithm>
#include <cmath>

#include "pose/pose_fit.hpp"
#include "pose/symmetry.hpp"
#include "voting/greedy_selection.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kSurfaceM = 0.002;   // what a mesh and a label's place may be off by
constexpr std::size_t kMaxWays = 12;  // of one object

/// How far a pose that was fitted to these sums may be off.
double slack_of(const PoseHypothesis& hypothesis, double most) {
  const Matrix6d covariance = covariance_of(hypothesis.sum.information);
  return std::min(kSurfaceM + std::sqrt(covariance.topLeftCorner<3, 3>().trace()), most);
}

bool same(const VotedHypothesis& a, const VotedHypothesis& b) {
  return a.hypothesis.type() == b.hypothesis.type() &&
         equivalent(*a.hypothesis.type(), a.hypothesis.T_world_object, b.hypothesis.T_world_object);
}

/// Fits a pose to a cluster, leaving out, one by one, what does not go with the rest.
std::optional<PoseHypothesis> trimmed(std::vector<const Correspondence*> correspondences,
                                      const Pose& start, const InlierThresholds& thresholds) {
  while (!correspondences.empty()) {
    const auto refined = refine(correspondences, start, thresholds.min_sigma_px());
    if (!refined) return std::nullopt;
    double worst = 1;
    std::size_t out = correspondences.size();
    for (std::size_t i = 0; i < correspondences.size(); ++i) {
      const double part =
          refined->each[i].chi_square / thresholds.largest_chi_square(*correspondences[i]);
      if (part <= worst) continue;
      worst = part;
      out = i;
    }
    if (out == correspondences.size())
      return explain(correspondences, refined->T_world_object, thresholds);
    correspondences.erase(correspondences.begin() + std::ptrdiff_t(out));
  }
  return std::nullopt;
}

}  // namespace

/// What the cluster around the vote explains; if that is little, what the vote alone leads to.
std::optional<VotedHypothesis> GreedyHypothesisSelection::hypothesis_from(std::size_t vote) {
  const Cluster cluster = accumulator_->cluster_around(vote);
  auto best = expanded(trimmed(cluster.correspondences, cluster.T_world_object, thresholds_));
  if (!best || best->correspondences.size() < kReliableMeasurements) {
    const Vote& alone = accumulator_->vote(vote);
    auto other = expanded(explain(alone.correspondences, alone.T_world_object, thresholds_));
    if (other && (!best || best->score(thresholds_) < other->score(thresholds_)))
      best = std::move(other);
  }
  if (!best || best->sum.points < kMinPoints) return std::nullopt;
  LabelVotes label_votes = label_evidence_->label_votes(*best->type(), best->T_world_object,
                                                        slack_of(*best, options_.merge_m), free_);
  return VotedHypothesis{std::move(*best), std::move(label_votes)};
}

std::optional<PoseHypothesis> GreedyHypothesisSelection::expanded(
    const std::optional<PoseHypothesis>& start) const {
  if (!start) return std::nullopt;
  return expand_consensus(start->correspondences, start->T_world_object,
                          pool(*start->type(), start->T_world_object), thresholds_);
}

/// Correspondences that the object may have: those whose first point, or whose frame, is as near to
/// the object's middle as its body reaches.
std::vector<const Correspondence*> GreedyHypothesisSelection::pool(
    const ObjectType& type, const Pose& T_world_object) const {
  const TypeBody& body = label_evidence_->body(type);
  const Eigen::Vector3d centre = T_world_object * body.centre();
  std::vector<const Correspondence*> near;
  for (const Correspondence* correspondence : correspondences_of_.at(&type)) {
    if (!free_[correspondence->number]) continue;
    const Measurement& measurement = *correspondence->measurement;
    const Eigen::Vector3d p = measurement.T_cam_world * centre;
    const double reach = 1.5 * body.radius_m() + options_.merge_m;
    if (const SeenPoints* seen = measurement.points()) {
      const Intrinsics& k = measurement.view->lens.intrinsics();
      if (p.z() < 2 * reach) {  // so near that pixels say little
        near.push_back(correspondence);
        continue;
      }
      const double reach_px = std::max(k.fx, k.fy) * reach / (p.z() - reach) + options_.inlier_px;
      const Eigen::Vector2d away = measurement.view->lens.project(p) - seen->pixels.front();
      if (away.norm() <= 1.5 * reach_px) near.push_back(correspondence);
    } else if ((measurement.pose()->T_cam_feature.translation() - p).norm() <=
               2 * reach + 3 * measurement.pose()->sigma_m +
                   correspondence->T_object_feature.translation().norm()) {
      near.push_back(correspondence);
    }
  }
  return near;
}

bool GreedyHypothesisSelection::worth_trying(
    std::size_t vote, const std::vector<std::size_t>& measurements,
    const std::vector<VotedHypothesis>& voted_hypotheses) const {
  if (!accumulator_->open(vote)) return false;
  const PoseHypothesis& first = voted_hypotheses.front().hypothesis;
  if (first.correspondences.size() < kReliableMeasurements) return true;
  for (const VotedHypothesis& voted : voted_hypotheses) {
    const PoseHypothesis& known = voted.hypothesis;
    if (accumulator_->may_be(vote, *known.type(), known.T_world_object)) return false;
  }
  // Others have to be for it, too.
  const Vote& candidate = accumulator_->vote(vote);
  std::size_t agree = 0;
  for (const std::size_t measurement : measurements) {
    const auto& votes = accumulator_->votes_of(measurement);
    agree += std::any_of(votes.begin(), votes.end(), [&](std::size_t other) {
      return accumulator_->may_be(other, *candidate.type(), candidate.T_world_object);
    });
  }
  return 2 * agree >= measurements.size();
}

std::vector<VotedHypothesis> GreedyHypothesisSelection::voted_hypotheses(VotedHypothesis first) {
  std::vector<std::size_t> measurements;
  for (const Correspondence* correspondence : first.hypothesis.correspondences)
    measurements.push_back(correspondence->number);
  std::vector<VotedHypothesis> voted_hypotheses;
  voted_hypotheses.push_back(std::move(first));
  for (const std::size_t measurement : measurements) {
    for (const std::size_t vote : accumulator_->votes_of(measurement)) {
      if (voted_hypotheses.size() >= kMaxWays ||
          !worth_trying(vote, measurements, voted_hypotheses))
        continue;
      auto voted = hypothesis_from(vote);
      if (!voted) continue;
      const std::size_t shared = common(voted->hypothesis, voted_hypotheses.front().hypothesis);
      const bool of_the_same =
          2 * shared >= voted->hypothesis.correspondences.size() &&
          2 * shared >= voted_hypotheses.front().hypothesis.correspondences.size();
      const bool known =
          std::any_of(voted_hypotheses.begin(), voted_hypotheses.end(),
                      [&](const VotedHypothesis& other) { return same(*voted, other); });
      if (of_the_same && !known) voted_hypotheses.push_back(std::move(*voted));
    }
  }
  return voted_hypotheses;
}

}  // namespace vantage::reconstruction::detail
