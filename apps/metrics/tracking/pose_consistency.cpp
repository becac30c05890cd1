#include "metrics/tracking/pose_consistency.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "metrics/tracking/steadiness.hpp"

namespace vantage {
namespace {

constexpr double kFreedom = 6;

/// The inverse of the normal distribution function, by bisection: erfc has none in the library.
double normal_quantile(double probability) {
  double low = -10, high = 10;
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(-middle / std::sqrt(2.0)) / 2 < probability ? low : high) = middle;
  }
  return (low + high) / 2;
}

double nees_of(const Eigen::Vector<double, 6>& error, const Matrix6d& covariance) {
  const Eigen::LDLT<Matrix6d> factors(covariance);
  if (factors.info() != Eigen::Success || !factors.isPositive()) {
    return std::numeric_limits<double>::infinity();  // it claims to be exact
  }
  return error.dot(factors.solve(error));
}

}  // namespace

double chi_square_quantile(double probability, double degrees) {
  const double spread = 2 / (9 * degrees);
  return degrees * std::pow(1 - spread + normal_quantile(probability) * std::sqrt(spread), 3);
}

void PoseConsistency::add(const PoseConsistency& other) {
  nees.insert(nees.end(), other.nees.begin(), other.nees.end());
}

double PoseConsistency::mean() const {
  if (nees.empty()) return 0;
  return std::accumulate(nees.begin(), nees.end(), 0.0) / double(nees.size());
}

double PoseConsistency::low() const {
  const double n = double(nees.size());
  return n == 0 ? 0 : chi_square_quantile(0.025, kFreedom * n) / n;
}

double PoseConsistency::high() const {
  const double n = double(nees.size());
  return n == 0 ? 0 : chi_square_quantile(0.975, kFreedom * n) / n;
}

double PoseConsistency::coverage() const {
  if (nees.empty()) return 0;
  const double limit = chi_square_quantile(0.95, kFreedom);
  return double(std::ranges::count_if(nees, [&](double x) { return x <= limit; })) /
         double(nees.size());
}

PoseConsistency pose_consistency(std::span<const TrackFrame> frames,
                                 std::span<const ComparedFrame> compared) {
  std::map<Standing, double> last;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto matches = matches_of(compared[i]);
    for (std::size_t t = 0; t < matches.size(); ++t) {
      if (!matches[t]) continue;
      const TruthAt& truth = frames[i].truth[compared[i].truth_index[t]];
      const EstimateAt& estimate = frames[i].estimates[compared[i].estimate_index[*matches[t]]];
      if (!estimate.covariance) continue;
      last[{truth.id, truth.since}] =
          nees_of(pose_error(estimate.T_world_object, truth.T_world_object), *estimate.covariance);
    }
  }
  PoseConsistency consistency;
  for (const auto& [standing, nees] : last) consistency.nees.push_back(nees);
  return consistency;
}

}  // namespace vantage
