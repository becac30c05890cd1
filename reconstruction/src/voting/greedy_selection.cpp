#include "voting/greedy_selection.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::reconstruction::detail {
namespace {

/// What the fit says against a way: chi-square above what noise makes of it, less what a
/// measurement that it explains is worth, as it needs no wrong id to explain it.
double cost_of(const FinalFit& fit, double scale) {
  double cost = 0;
  for (const LinearSystem& system : fit.hypothesis.each) {
    cost += (system.chi_square - 2 * system.points) / scale + 2 * std::log(kWrongId);
  }
  return cost;
}

}  // namespace

std::size_t common(const PoseHypothesis& a, const PoseHypothesis& b) {
  std::size_t count = 0;
  for (const Correspondence* correspondence : a.correspondences) {
    count += std::any_of(
        b.correspondences.begin(), b.correspondences.end(),
        [&](const Correspondence* other) { return other->number == correspondence->number; });
  }
  return count;
}

std::optional<SelectedHypothesis> weigh_hypotheses(std::vector<VotedHypothesis> voted_hypotheses,
                                                   double min_evidence) {
  std::vector<double> nets, costs;
  std::vector<FinalFit> fits;
  double scale = std::numeric_limits<double>::infinity();
  for (VotedHypothesis& voted : voted_hypotheses) {
    nets.push_back(voted.net());
    fits.push_back(generalized_least_squares(std::move(voted.hypothesis)));
    const double ratio = fits.back().chi_square / std::max(1, fits.back().degrees_of_freedom);
    scale = std::min(scale, std::max(1.0, ratio));
  }
  for (const FinalFit& fit : fits) costs.push_back(cost_of(fit, scale));
  const double least = *std::min_element(costs.begin(), costs.end());
  const bool tie = *std::max_element(nets.begin(), nets.end()) == 0;
  std::vector<std::pair<double, std::size_t>> shares;  // their logarithms, and whose they are
  for (std::size_t i = 0; i < voted_hypotheses.size(); ++i) {
    const double votes = tie && nets[i] == 0 ? 1 : nets[i];
    if (costs[i] - least > min_evidence || votes <= 0) continue;
    shares.emplace_back(std::log(votes) - 0.5 * (costs[i] - least), i);
  }
  if (shares.empty()) return std::nullopt;
  std::ranges::stable_sort(shares, [&](const auto& a, const auto& b) {
    return goes_before(a.first, fits[a.second].hypothesis, b.first, fits[b.second].hypothesis);
  });
  const PoseHypothesis best = fits[shares.front().second].hypothesis;
  std::erase_if(shares, [&](const auto& share) {
    return common(best, fits[share.second].hypothesis) < best.correspondences.size();
  });
  double sum = 0;
  for (const auto& [log, i] : shares) sum += std::exp(log);
  SelectedHypothesis selected;
  for (const auto& [log, i] : shares) {
    selected.candidate.voted_hypotheses.push_back(std::move(fits[i]));
    selected.candidate.shares.push_back(std::exp(log) / sum);
    selected.verdicts.push_back(std::move(voted_hypotheses[i].label_votes));
  }
  const double against = double(selected.verdicts.front().against);
  selected.net = nets[shares.front().second];
  const double in_favour = selected.net + against;
  selected.candidate.there = in_favour / (in_favour + against);
  return selected;
}

namespace {

constexpr double kLate = 1e6;  // comes after every height of the table

/// Of the feature; object's frame.
Eigen::Vector3d middle_of(const Correspondence& correspondence) {
  if (correspondence.points_m.empty()) return correspondence.T_object_feature.translation();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : correspondence.points_m) sum += point;
  return sum / double(correspondence.points_m.size());
}

}  // namespace

GreedyHypothesisSelection::GreedyHypothesisSelection(const CandidateCorrespondences& candidates,
                                                     const ReconstructOptions& options,
                                                     const VoteGrid& grid)
    : candidates_(&candidates),
      options_(options),
      thresholds_{options.inlier_px},
      free_(candidates.measurements.size(), true),
      reasons_(candidates.measurements.size()) {
  std::vector<Vote> votes = cast_votes(candidates, thresholds_);
  label_evidence_ = std::make_unique<LabelEvidence>(candidates, votes);
  accumulator_ =
      std::make_unique<HoughAccumulator>(std::move(votes), candidates.measurements.size(), grid);
  for (const Correspondence& correspondence : candidates.correspondences) {
    correspondences_of_[&correspondence.type()].push_back(&correspondence);
  }
  rank_votes();
}

void GreedyHypothesisSelection::rank_votes() {
  label_score_.resize(accumulator_->size());
  deferred_.resize(accumulator_->size());
  tbb::parallel_for(std::size_t(0), accumulator_->size(), [&](std::size_t i) {
    if (!accumulator_->open(i)) return;
    const Vote& vote = accumulator_->vote(i);
    const LabelVotes label_votes =
        label_evidence_->label_votes(*vote.type(), vote.T_world_object, options_.merge_m, free_);
    label_score_[i] = double(label_votes.labels.size()) - double(label_votes.against);
  });
  for (std::size_t i = 0; i < accumulator_->size(); ++i) {
    if (accumulator_->open(i)) queue_.push_back({height(i), i});
  }
  std::make_heap(queue_.begin(), queue_.end());
}

double GreedyHypothesisSelection::height(std::size_t vote) const {
  return accumulator_->height(vote) + label_score_[vote];
}

std::optional<SelectedHypothesis> GreedyHypothesisSelection::next() {
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end());
    const Entry top = queue_.back();
    queue_.pop_back();
    if (!accumulator_->open(top.vote)) continue;
    const double now = height(top.vote);
    if (!deferred_[top.vote] && now < top.height) {  // others were withdrawn since
      put_back({now, top.vote});
      continue;
    }
    if (auto selected = selected_around(top)) return selected;
  }
  return std::nullopt;
}

std::optional<SelectedHypothesis> GreedyHypothesisSelection::selected_around(const Entry& entry) {
  const std::size_t vote = entry.vote;
  auto first = hypothesis_from(vote);
  if (!first) {
    drop(vote, "no pose of an object explains it");
    return std::nullopt;
  }
  const PoseHypothesis start = first->hypothesis;
  auto selected = weigh_hypotheses(voted_hypotheses(std::move(*first)), options_.min_evidence);
  if (selected && !taken(selected->candidate.best())) {
    if (defer(entry, selected->net)) return std::nullopt;
    accept(*selected);
    return selected;
  }
  const std::string reason = selected ? "there is already an object of its type"
                                      : "more observations contradict its object than support it";
  drop_votes_for(start, reason);
  drop(vote, reason);
  return std::nullopt;
}

void GreedyHypothesisSelection::put_back(const Entry& entry) {
  queue_.push_back(entry);
  std::push_heap(queue_.begin(), queue_.end());
}

/// Puts off what few votes are for until all that more votes are for is found, and again if it has
/// fewer now than it had then: vague votes stand lower in the table than precise ones, although
/// more of them may agree.
bool GreedyHypothesisSelection::defer(const Entry& entry, double net) {
  if (net >= double(kReliableMeasurements) ||
      (deferred_[entry.vote] && net - kLate >= entry.height))
    return false;
  deferred_[entry.vote] = true;
  put_back({net - kLate, entry.vote});
  return true;
}

void GreedyHypothesisSelection::drop(std::size_t vote, const std::string& reason) {
  for (const Correspondence* correspondence : accumulator_->vote(vote).correspondences)
    reasons_[correspondence->number] = reason;
  accumulator_->withdraw(vote);
}

void GreedyHypothesisSelection::drop_votes_for(const PoseHypothesis& hypothesis,
                                               const std::string& reason) {
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    for (const std::size_t vote : accumulator_->votes_of(correspondence->number)) {
      if (accumulator_->open(vote) &&
          accumulator_->may_be(vote, *hypothesis.type(), hypothesis.T_world_object)) {
        drop(vote, reason);
      }
    }
    reasons_[correspondence->number] = reason;
  }
}

/// Two objects of a type are not in one place, nor are their features: corners that are off by more
/// than `inlier_px` may, alone, be tilted to somewhere else.
bool GreedyHypothesisSelection::taken(const PoseHypothesis& hypothesis) const {
  const TypePtr& type = hypothesis.type();
  const auto near = [&](const Pose& other, const Eigen::Vector3d& p) {
    return (other * p - hypothesis.T_world_object * p).norm() < options_.merge_m;
  };
  return std::any_of(objects_.begin(), objects_.end(), [&](const auto& object) {
    if (object.first != type.get()) return false;
    const auto& correspondences = hypothesis.correspondences;
    return near(object.second, label_evidence_->body(*type).centre()) ||
           std::all_of(correspondences.begin(), correspondences.end(),
                       [&](const Correspondence* correspondence) {
                         return near(object.second, middle_of(*correspondence));
                       });
  });
}

void GreedyHypothesisSelection::accept(const SelectedHypothesis& selected) {
  const PoseHypothesis& hypothesis = selected.candidate.best();
  objects_.emplace_back(hypothesis.type().get(), hypothesis.T_world_object);
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    free_[correspondence->number] = false;
    for (const std::size_t vote : accumulator_->votes_of(correspondence->number))
      accumulator_->withdraw(vote);
  }
  label_evidence_->place(hypothesis.correspondences, hypothesis.T_world_object);
  for (const auto& [measurement, feature] : selected.verdicts.front().labels)
    free_[measurement] = false;
}

std::string GreedyHypothesisSelection::reason_against(std::size_t measurement) const {
  if (!reasons_[measurement].empty()) return reasons_[measurement];
  const Measurement& seen = candidates_->measurements[measurement];
  if (seen.label()) return "no object that carries " + name_of(seen.observation->key) + " is there";
  if (accumulator_->votes_of(measurement).empty()) {
    return "has no pose of its own, and no object is where its object would have to be";
  }
  return "no object explains it";
}

}  // namespace vantage::reconstruction::detail
