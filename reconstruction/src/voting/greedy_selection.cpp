#include "voting/greedy_selection.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::detail {
namespace {

/// What the fit says against a way: chi-square above what noise makes of it, less what a sighting
/// that it explains is worth, as it needs no wrong id to explain it.
double cost_of(const FinalFit& fit, double scale) {
  double cost = 0;
  for (const Evidence& evidence : fit.explanation.each) {
    cost += (evidence.chi_square - 2 * evidence.points) / scale + 2 * std::log(kWrongId);
  }
  return cost;
}

}  // namespace

std::size_t common(const Explanation& a, const Explanation& b) {
  std::size_t count = 0;
  for (const Reading* reading : a.readings) {
    count += std::any_of(b.readings.begin(), b.readings.end(),
                         [&](const Reading* other) { return other->number == reading->number; });
  }
  return count;
}

std::optional<Elected> weighed(std::vector<Way> ways, double least_evidence) {
  std::vector<double> nets, costs;
  std::vector<FinalFit> fits;
  double scale = std::numeric_limits<double>::infinity();
  for (Way& way : ways) {
    nets.push_back(way.net());
    fits.push_back(fit_finally(std::move(way.explanation)));
    const double ratio = fits.back().chi_square / std::max(1, fits.back().degrees_of_freedom);
    scale = std::min(scale, std::max(1.0, ratio));
  }
  for (const FinalFit& fit : fits) costs.push_back(cost_of(fit, scale));
  const double least = *std::min_element(costs.begin(), costs.end());
  const bool tie = *std::max_element(nets.begin(), nets.end()) == 0;
  std::vector<std::pair<double, std::size_t>> shares;  // their logarithms, and whose they are
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double votes = tie && nets[i] == 0 ? 1 : nets[i];
    if (costs[i] - least > least_evidence || votes <= 0) continue;
    shares.emplace_back(std::log(votes) - 0.5 * (costs[i] - least), i);
  }
  if (shares.empty()) return std::nullopt;
  std::ranges::stable_sort(shares, [&](const auto& a, const auto& b) {
    return goes_before(a.first, fits[a.second].explanation, b.first, fits[b.second].explanation);
  });
  const Explanation best = fits[shares.front().second].explanation;
  std::erase_if(shares, [&](const auto& share) {
    return common(best, fits[share.second].explanation) < best.readings.size();
  });
  double sum = 0;
  for (const auto& [log, i] : shares) sum += std::exp(log);
  Elected elected;
  for (const auto& [log, i] : shares) {
    elected.candidate.ways.push_back(std::move(fits[i]));
    elected.candidate.shares.push_back(std::exp(log) / sum);
    elected.verdicts.push_back(std::move(ways[i].verdict));
  }
  const double against = double(elected.verdicts.front().against);
  elected.net = nets[shares.front().second];
  const double in_favour = elected.net + against;
  elected.candidate.there = in_favour / (in_favour + against);
  return elected;
}

namespace {

constexpr double kLate = 1e6;  // comes after every height of the table

/// Of the feature; object's frame.
Eigen::Vector3d middle_of(const Reading& reading) {
  if (reading.points_m.empty()) return reading.T_object_feature.translation();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : reading.points_m) sum += point;
  return sum / double(reading.points_m.size());
}

}  // namespace

Election::Election(const Ballot& ballot, const ReconstructOptions& options, const VoteGrid& grid)
    : ballot_(&ballot),
      options_(options),
      bounds_{options.inlier_px},
      free_(ballot.sightings.size(), true),
      reasons_(ballot.sightings.size()) {
  std::vector<Vote> votes = cast_votes(ballot, bounds_);
  witnesses_ = std::make_unique<Witnesses>(ballot, votes);
  poll_ = std::make_unique<Poll>(std::move(votes), ballot.sightings.size(), grid);
  for (const Reading& reading : ballot.readings) {
    readings_of_[&reading.type()].push_back(&reading);
  }
  rank_votes();
}

void Election::rank_votes() {
  said_.resize(poll_->size());
  deferred_.resize(poll_->size());
  tbb::parallel_for(std::size_t(0), poll_->size(), [&](std::size_t i) {
    if (!poll_->open(i)) return;
    const Vote& vote = poll_->vote(i);
    const Verdict verdict =
        witnesses_->verdict(*vote.type(), vote.T_world_object, options_.merge_m, free_);
    said_[i] = double(verdict.labels.size()) - double(verdict.against);
  });
  for (std::size_t i = 0; i < poll_->size(); ++i) {
    if (poll_->open(i)) queue_.push_back({height(i), i});
  }
  std::make_heap(queue_.begin(), queue_.end());
}

double Election::height(std::size_t vote) const {
  return poll_->height(vote) + said_[vote];
}

std::optional<Elected> Election::next() {
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end());
    const Entry top = queue_.back();
    queue_.pop_back();
    if (!poll_->open(top.vote)) continue;
    const double now = height(top.vote);
    if (!deferred_[top.vote] && now < top.height) {  // others were withdrawn since
      put_back({now, top.vote});
      continue;
    }
    if (auto elected = elected_around(top)) return elected;
  }
  return std::nullopt;
}

std::optional<Elected> Election::elected_around(const Entry& entry) {
  const std::size_t vote = entry.vote;
  auto first = way_from(vote);
  if (!first) {
    drop(vote, "no pose of an object explains it");
    return std::nullopt;
  }
  const Explanation start = first->explanation;
  auto elected = weighed(ways(std::move(*first)), options_.least_evidence);
  if (elected && !taken(elected->candidate.best())) {
    if (defer(entry, elected->net)) return std::nullopt;
    accept(*elected);
    return elected;
  }
  const std::string reason =
      elected ? "an object of the type that it would be is there already"
              : "more observations speak against the object that it would be than for it";
  drop_votes_for(start, reason);
  drop(vote, reason);
  return std::nullopt;
}

void Election::put_back(const Entry& entry) {
  queue_.push_back(entry);
  std::push_heap(queue_.begin(), queue_.end());
}

/// Puts off what few votes are for until all that more votes are for is found, and again if it has
/// fewer now than it had then: vague votes stand lower in the table than precise ones, although
/// more of them may agree.
bool Election::defer(const Entry& entry, double net) {
  if (net >= double(kFirm) || (deferred_[entry.vote] && net - kLate >= entry.height)) return false;
  deferred_[entry.vote] = true;
  put_back({net - kLate, entry.vote});
  return true;
}

void Election::drop(std::size_t vote, const std::string& reason) {
  for (const Reading* reading : poll_->vote(vote).readings) reasons_[reading->number] = reason;
  poll_->withdraw(vote);
}

void Election::drop_votes_for(const Explanation& explanation, const std::string& reason) {
  for (const Reading* reading : explanation.readings) {
    for (const std::size_t vote : poll_->votes_of(reading->number)) {
      if (poll_->open(vote) &&
          poll_->may_be(vote, *explanation.type(), explanation.T_world_object)) {
        drop(vote, reason);
      }
    }
    reasons_[reading->number] = reason;
  }
}

/// Two objects of a type are not in one place, nor are their features: corners that are off by more
/// than `inlier_px` may, alone, be tilted to somewhere else.
bool Election::taken(const Explanation& explanation) const {
  const TypePtr& type = explanation.type();
  const auto near = [&](const Pose& other, const Eigen::Vector3d& p) {
    return (other * p - explanation.T_world_object * p).norm() < options_.merge_m;
  };
  return std::any_of(objects_.begin(), objects_.end(), [&](const auto& object) {
    if (object.first != type.get()) return false;
    const auto& readings = explanation.readings;
    return near(object.second, witnesses_->body(*type).centre()) ||
           std::all_of(readings.begin(), readings.end(), [&](const Reading* reading) {
             return near(object.second, middle_of(*reading));
           });
  });
}

void Election::accept(const Elected& elected) {
  const Explanation& explanation = elected.candidate.best();
  objects_.emplace_back(explanation.type().get(), explanation.T_world_object);
  for (const Reading* reading : explanation.readings) {
    free_[reading->number] = false;
    for (const std::size_t vote : poll_->votes_of(reading->number)) poll_->withdraw(vote);
  }
  witnesses_->place(explanation.readings, explanation.T_world_object);
  for (const auto& [sighting, feature] : elected.verdicts.front().labels) free_[sighting] = false;
}

std::string Election::reason_against(std::size_t sighting) const {
  if (!reasons_[sighting].empty()) return reasons_[sighting];
  const Sighting& seen = ballot_->sightings[sighting];
  if (seen.label()) return "no object that carries " + name_of(seen.observation->key) + " is there";
  if (poll_->votes_of(sighting).empty()) {
    return "has no pose of its own, and no object is where it would have to be";
  }
  return "no object explains it";
}

}  // namespace vantage::detail
