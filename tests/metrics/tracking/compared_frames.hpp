#pragma once

#include <utility>
#include <vector>

#include "metrics/tracking/track_frame.hpp"

namespace vantage::test {

/// A frame of true objects 1, 2, … of types 0, 1, …; `estimates` has for each estimate its id, the
/// true object that it lies on, 0 for none, and how well.
struct SeenAs {
  std::uint64_t id = 0;
  std::size_t truth = 0;
  double similarity = 1;
};

inline ComparedFrame compared_frame(std::size_t truth, const std::vector<SeenAs>& estimates) {
  ComparedFrame frame;
  for (std::size_t t = 0; t < truth; ++t) {
    frame.truth.push_back(t + 1);
    frame.truth_types.push_back(t);
  }
  frame.similarity = Eigen::MatrixXd::Zero(Eigen::Index(truth), Eigen::Index(estimates.size()));
  for (std::size_t e = 0; e < estimates.size(); ++e) {
    frame.estimates.push_back(estimates[e].id);
    if (estimates[e].truth == 0) continue;
    frame.similarity(Eigen::Index(estimates[e].truth) - 1, Eigen::Index(e)) =
        estimates[e].similarity;
  }
  frame.nearness = frame.similarity;
  return frame;
}

}  // namespace vantage::test
