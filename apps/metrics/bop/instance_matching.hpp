#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace vantage {

/// The true object that an estimate was matched to, and its error.
struct Match {
  std::size_t truth = 0;
  double error = 0;
};

/// BOP's greedy matching (pose_matching.py): estimates in the order of falling score, the earlier
/// among equals; each takes the true object, free as yet, to which its error is least and below the
/// threshold, the earlier among equals. One to one.
/// @param errors estimates × true objects; infinite between objects of different types.
/// @param scores of the estimates.
/// @returns for each estimate what it was matched to, if anything.
std::vector<std::optional<Match>> match_instances(const Eigen::MatrixXd& errors,
                                                  std::span<const double> scores, double threshold);

/// How many of the true objects with `counts` were found.
std::size_t found(std::span<const std::optional<Match>> matches, const std::vector<bool>& counts);

}  // namespace vantage
