#include "metrics/tracking/identity_scores.hpp"

#include <map>

#include "metrics/tracking/assignment.hpp"

namespace vantage {
namespace {

/// Numbers tracks from 0, in the order of their ids.
class TrackNumbers {
 public:
  void add(const std::vector<std::uint64_t>& ids) {
    for (const std::uint64_t id : ids) numbers_.emplace(id, 0);
  }
  void finish() {
    Eigen::Index next = 0;
    for (auto& [id, number] : numbers_) number = next++;
  }
  Eigen::Index of(std::uint64_t id) const { return numbers_.at(id); }
  Eigen::Index count() const { return Eigen::Index(numbers_.size()); }

 private:
  std::map<std::uint64_t, Eigen::Index> numbers_;
};

/// In how many frames each two tracks stand for each other.
Eigen::MatrixXd common_frames(std::span<const ComparedFrame> frames) {
  TrackNumbers truth, estimates;
  for (const ComparedFrame& frame : frames) {
    truth.add(frame.truth);
    estimates.add(frame.estimates);
  }
  truth.finish();
  estimates.finish();
  Eigen::MatrixXd common = Eigen::MatrixXd::Zero(truth.count(), estimates.count());
  for (const ComparedFrame& frame : frames) {
    for (Eigen::Index t = 0; t < frame.similarity.rows(); ++t) {
      for (Eigen::Index e = 0; e < frame.similarity.cols(); ++e) {
        if (frame.similarity(t, e) < kSameObjectSimilarity) continue;
        common(truth.of(frame.truth[std::size_t(t)]),
               estimates.of(frame.estimates[std::size_t(e)])) += 1;
      }
    }
  }
  return common;
}

/// Above any sum of similarities in a frame: a pair that goes on is kept.
constexpr double kKeep = 1000;

/// Matches of a frame that keep as many as can be of those before it.
std::vector<std::optional<std::size_t>> continued_matches(
    const ComparedFrame& frame, const Eigen::MatrixXd& likeness,
    const std::map<std::uint64_t, std::uint64_t>& last) {
  Eigen::MatrixXd gains = likeness;
  for (Eigen::Index t = 0; t < gains.rows(); ++t) {
    const auto before = last.find(frame.truth[std::size_t(t)]);
    for (Eigen::Index e = 0; e < gains.cols(); ++e) {
      if (gains(t, e) < kSameObjectSimilarity) {
        gains(t, e) = 0;
      } else if (before != last.end() && before->second == frame.estimates[std::size_t(e)]) {
        gains(t, e) += kKeep;
      }
    }
  }
  return best_assignment(gains);
}

/// Ids that go from a true object of one type to one of another.
class TypeSwitches {
 public:
  std::size_t in(const ComparedFrame& frame) {
    std::size_t count = 0;
    const auto matches = continued_matches(frame, frame.nearness, estimate_of_);
    for (std::size_t t = 0; t < matches.size(); ++t) {
      if (!matches[t]) continue;
      const std::uint64_t estimate = frame.estimates[*matches[t]];
      estimate_of_[frame.truth[t]] = estimate;
      const auto [type, is_new] = type_of_.try_emplace(estimate, frame.truth_types[t]);
      if (type->second != frame.truth_types[t]) ++count;
      type->second = frame.truth_types[t];
    }
    return count;
  }

 private:
  std::map<std::uint64_t, std::uint64_t> estimate_of_;
  std::map<std::uint64_t, std::size_t> type_of_;
};

}  // namespace

IdentityScores identity_scores(std::span<const ComparedFrame> frames) {
  IdentityScores scores;
  for (const ComparedFrame& frame : frames) {
    scores.truth += frame.truth.size();
    scores.estimates += frame.estimates.size();
  }
  const Eigen::MatrixXd common = common_frames(frames);
  const auto matches = best_assignment(common);
  for (std::size_t t = 0; t < matches.size(); ++t) {
    if (!matches[t]) continue;
    scores.true_positives += std::size_t(common(Eigen::Index(t), Eigen::Index(*matches[t])));
  }
  return scores;
}

ClearScores clear_scores(std::span<const ComparedFrame> frames) {
  ClearScores scores;
  TypeSwitches types;
  std::map<std::uint64_t, std::uint64_t> last;
  for (const ComparedFrame& frame : frames) {
    const auto matches = continued_matches(frame, frame.similarity, last);
    std::size_t found = 0;
    for (std::size_t t = 0; t < matches.size(); ++t) {
      if (!matches[t]) continue;
      ++found;
      const std::uint64_t estimate = frame.estimates[*matches[t]];
      const auto [before, is_new] = last.try_emplace(frame.truth[t], estimate);
      if (before->second != estimate) ++scores.switches;
      before->second = estimate;
    }
    scores.truth += frame.truth.size();
    scores.misses += frame.truth.size() - found;
    scores.false_positives += frame.estimates.size() - found;
    if (!frame.truth_types.empty()) scores.type_switches += types.in(frame);
  }
  return scores;
}

}  // namespace vantage
