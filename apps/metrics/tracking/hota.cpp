#include "metrics/tracking/hota.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "metrics/tracking/assignment.hpp"

namespace vantage {
namespace {

constexpr int kThresholds = 19;
constexpr double kRounding = 1e-12;

using TrackPair = std::pair<std::uint64_t, std::uint64_t>;

/// In how many frames each track is there, and how well two tracks go together.
struct TrackCounts {
  std::map<std::uint64_t, double> truth, estimates;
  std::map<TrackPair, double> potential;

  explicit TrackCounts(std::span<const ComparedFrame> frames) {
    for (const ComparedFrame& frame : frames) add(frame);
  }

  void add(const ComparedFrame& frame) {
    for (const std::uint64_t id : frame.truth) ++truth[id];
    for (const std::uint64_t id : frame.estimates) ++estimates[id];
    const Eigen::VectorXd rows = frame.similarity.rowwise().sum();
    const Eigen::RowVectorXd columns = frame.similarity.colwise().sum();
    for (Eigen::Index t = 0; t < frame.similarity.rows(); ++t) {
      for (Eigen::Index e = 0; e < frame.similarity.cols(); ++e) {
        const double s = frame.similarity(t, e);
        if (s <= 0) continue;
        const TrackPair pair{frame.truth[std::size_t(t)], frame.estimates[std::size_t(e)]};
        potential[pair] += s / (rows[t] + columns[e] - s);
      }
    }
  }

  double alignment(const TrackPair& pair) const {
    const auto found = potential.find(pair);
    if (found == potential.end()) return 0;
    return found->second / (truth.at(pair.first) + estimates.at(pair.second) - found->second);
  }
};

/// One threshold's.
struct ThresholdCounts {
  double hits = 0;
  std::map<TrackPair, double> matches = {};

  double association(const TrackCounts& counts) const {
    double sum = 0;
    for (const auto& [pair, n] : matches) {
      sum += n * n / (counts.truth.at(pair.first) + counts.estimates.at(pair.second) - n);
    }
    return sum / std::max(1.0, hits);
  }
};

void count_matches(const ComparedFrame& frame, const TrackCounts& counts,
                   std::vector<ThresholdCounts>& thresholds) {
  Eigen::MatrixXd gains = frame.similarity;
  for (Eigen::Index t = 0; t < gains.rows(); ++t) {
    for (Eigen::Index e = 0; e < gains.cols(); ++e) {
      gains(t, e) *=
          counts.alignment({frame.truth[std::size_t(t)], frame.estimates[std::size_t(e)]});
    }
  }
  const auto matches = best_assignment(gains);
  for (std::size_t t = 0; t < matches.size(); ++t) {
    if (!matches[t]) continue;
    const double similarity = frame.similarity(Eigen::Index(t), Eigen::Index(*matches[t]));
    for (int i = 0; i < kThresholds; ++i) {
      if (similarity < 0.05 * (i + 1) - kRounding) break;
      ++thresholds[std::size_t(i)].hits;
      ++thresholds[std::size_t(i)].matches[{frame.truth[t], frame.estimates[*matches[t]]}];
    }
  }
}

}  // namespace

HotaScores hota(std::span<const ComparedFrame> frames) {
  const TrackCounts counts(frames);
  std::vector<ThresholdCounts> thresholds(kThresholds);
  double truth = 0, estimates = 0;
  for (const ComparedFrame& frame : frames) {
    truth += double(frame.truth.size());
    estimates += double(frame.estimates.size());
    count_matches(frame, counts, thresholds);
  }
  HotaScores scores;
  for (const ThresholdCounts& at : thresholds) {
    const double detection = at.hits / std::max(1.0, truth + estimates - at.hits);
    const double association = at.association(counts);
    scores.detection += detection;
    scores.association += association;
    scores.hota += std::sqrt(detection * association);
  }
  for (double* score : {&scores.detection, &scores.association, &scores.hota}) {
    *score /= kThresholds;  // last, so that a perfect one is exactly 1
  }
  return scores;
}

}  // namespace vantage
