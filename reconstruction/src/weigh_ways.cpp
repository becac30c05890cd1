#include <algorithm>
#include <cmath>
#include <limits>

#include "election.hpp"

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

}  // namespace vantage::detail
