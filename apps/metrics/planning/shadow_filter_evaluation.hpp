#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "metrics/planning/shadow_score.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

/// A filter for false shadow; all zeros: no filter.
struct ShadowFilter {
  double offset_sigmas = 0;  ///< of the visibility mesh's surface
  int opening_voxels = 0;    ///< the radius of the opening
  double min_m3 = 0;         ///< smaller connected regions are removed
};

/// The filters' scores in one scene, one for each filter.
struct FilteredScene {
  std::string name;
  double hidden_m3 = 0;  ///< truly, in some camera's view and off the boundary
  std::vector<ShadowScore> scores{};
};

/// Filters for false shadow, each in every scene.
struct ShadowFilterEvaluation {
  double voxel_size_m = 0;
  std::vector<ShadowFilter> filters;
  std::vector<FilteredScene> scenes;
};

/// A filter's means over the scenes that have values.
struct FilterMeans {
  std::optional<double> precision, recall, f1;
  double false_m3 = 0, missed_m3 = 0;
};
FilterMeans means_of(const ShadowFilterEvaluation& evaluation, std::size_t filter);

/// The filter with the largest mean F1; of equals, the first. None if no scene has any.
std::optional<std::size_t> best_filter(const ShadowFilterEvaluation& evaluation);

/// All filters' means, and what the best one makes of each scene.
std::vector<ReportTable> shadow_filter_tables(const ShadowFilterEvaluation& evaluation);

}  // namespace vantage
