#include "metrics/plot/run_summary.hpp"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// A run's mean of one of the objects' errors is appended; nothing where nothing was matched.
void append_mean(const ReconstructionScore& score, double ObjectErrors::*error,
                 std::vector<double>& values) {
  if (score.objects.empty()) return;
  double sum = 0;
  for (const ObjectErrors& object : score.objects) sum += object.*error;
  values.push_back(sum / double(score.objects.size()));
}

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return {};
  return double(part) / double(whole);
}

}  // namespace

std::optional<Spread> spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  const std::size_t n = values.size();
  double beyond_first = 0;  // so that equal values have exactly their own mean
  for (const double value : values) beyond_first += value - values[0];
  Spread spread{n, values[0] + beyond_first / double(n)};
  double squares = 0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (n > 1) spread.deviation = std::sqrt(squares / double(n - 1));
  std::ranges::sort(values);
  spread.median = (values[(n - 1) / 2] + values[n / 2]) / 2;
  spread.largest = values.back();
  return spread;
}

RunSummary summary_of(std::span<const SubsetRun* const> runs, std::size_t method) {
  std::vector<double> translations, rotations, mssds, consistencies;
  RunSummary summary;
  summary.runs = runs.size();
  std::size_t found_at = 0, to_find_at = 0;
  for (const SubsetRun* run : runs) {
    const ReconstructionScore& score = run->scores[method];
    append_mean(score, &ObjectErrors::translation_m, translations);
    append_mean(score, &ObjectErrors::rotation_rad, rotations);
    append_mean(score, &ObjectErrors::mssd_m, mssds);
    if (score.self_consistency_mm2) consistencies.push_back(*score.self_consistency_mm2);
    summary.true_objects += score.true_objects;
    summary.estimates += score.estimates;
    summary.found += score.found;
    summary.correct += score.correct;
    for (const std::size_t found : score.found_at) found_at += found;
    to_find_at += score.found_at.size() * score.true_objects;
  }
  summary.translation_m = spread_of(std::move(translations));
  summary.rotation_rad = spread_of(std::move(rotations));
  summary.mssd_m = spread_of(std::move(mssds));
  summary.self_consistency_mm2 = spread_of(std::move(consistencies));
  summary.recall = share(summary.found, summary.true_objects);
  summary.precision = share(summary.correct, summary.estimates);
  summary.average_recall = share(found_at, to_find_at);
  return summary;
}

}  // namespace vantage
