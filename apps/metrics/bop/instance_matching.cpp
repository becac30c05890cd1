#include "metrics/bop/instance_matching.hpp"

#include <algorithm>
#include <numeric>

namespace vantage {

std::vector<std::optional<Match>> match_instances(const Eigen::MatrixXd& errors,
                                                  std::span<const double> scores,
                                                  double threshold) {
  std::vector<std::size_t> order(std::size_t(errors.rows()));
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  std::vector<std::optional<Match>> matches(order.size());
  std::vector<bool> taken(std::size_t(errors.cols()), false);
  for (const std::size_t estimate : order) {
    std::optional<Match>& match = matches[estimate];
    for (std::size_t truth = 0; truth < taken.size(); ++truth) {
      const double error = errors(Eigen::Index(estimate), Eigen::Index(truth));
      if (!taken[truth] && error < (match ? match->error : threshold)) match = {truth, error};
    }
    if (match) taken[match->truth] = true;
  }
  return matches;
}

std::size_t found(std::span<const std::optional<Match>> matches, const std::vector<bool>& counts) {
  return std::size_t(std::ranges::count_if(
      matches, [&](const auto& match) { return match && counts[match->truth]; }));
}

}  // namespace vantage
