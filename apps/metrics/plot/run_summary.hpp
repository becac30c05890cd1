#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "metrics/reconstruction/subset_evaluation.hpp"

namespace vantage {

/// How values are spread.
struct Spread {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  ///< of the sample (n - 1); 0 for a single value
  double median = 0;     ///< the mean of the middle two for an even count
  double largest = 0;
};

/// Nothing for no values.
std::optional<Spread> spread_of(std::vector<double> values);

/// One method over many runs. A run's value is the mean over its objects; the self-consistency
/// error is the scene's.
struct RunSummary {
  std::size_t runs = 0;
  std::optional<Spread> translation_m, rotation_rad, mssd_m, self_consistency_mm2;
  std::size_t true_objects = 0, estimates = 0, found = 0, correct = 0;
  std::optional<double> recall;          ///< found / true_objects
  std::optional<double> precision;       ///< correct / estimates
  std::optional<double> average_recall;  ///< BOP's AR of MSSD: the mean over its thresholds
};

/// Of `method` over all of these runs.
RunSummary summary_of(std::span<const SubsetRun* const> runs, std::size_t method);

}  // namespace vantage
