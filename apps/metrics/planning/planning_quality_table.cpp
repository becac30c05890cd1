#include "metrics/planning/planning_tables.hpp"

#include <fmt/format.h>

#include <optional>

#include "metrics/planning/planning_numbers.hpp"
#include "metrics/planning/thesis_planning.hpp"

namespace vantage {
namespace {

/// What table 9.6 says of a method, in a scene or on average.
struct ThesisQuality {
  double vox_quality = 0, full_s = 0, production_s = 0;
};

template <class Row>
std::optional<ThesisQuality> quality_of(const Row* row) {
  if (row == nullptr) return std::nullopt;
  return ThesisQuality{row->vox_quality, row->run_time_s, row->production_run_time_s};
}

TableRow quality_row(const std::string& method, const std::optional<SetComparison>& ours,
                     const std::optional<ThesisQuality>& thesis) {
  TableRow row{{method}};
  if (ours) {
    row.cells.insert(
        row.cells.end(),
        {fmt::format("{:.4f}", ours->production_share), fmt::format("{:.4f}", ours->vox_quality),
         time_text(ours->full_s) + " → " + time_text(ours->production_s),
         times_text(ours->speed_up())});
  } else {
    row.cells.insert(row.cells.end(), {kNone, kNone, kNone, kNone});
  }
  if (thesis) {
    row.cells.insert(row.cells.end(),
                     {fmt::format("{:.2f}", thesis->vox_quality),
                      time_text(thesis->full_s) + " → " + time_text(thesis->production_s),
                      times_text(thesis->full_s / thesis->production_s)});
  } else {
    row.cells.insert(row.cells.end(), {kNone, kNone, kNone});
  }
  return row;
}

}  // namespace

ReportTable quality_table(const PlanningEvaluation& evaluation) {
  ReportTable table{"Production set against full set (thesis: table 9.6)",
                    {{"method", "", true},
                     {"production / full"},
                     {"full / production"},
                     {"run time"},
                     {"speed-up"},
                     {"full / production", "thesis"},
                     {"run time", "thesis"},
                     {"speed-up", "thesis"}}};
  for (const SceneEvaluation& scene : evaluation.scenes) {
    if (!compare_sets(scene, "voxel")) continue;
    table.section(scene.name);
    for (const std::string& method : evaluation.methods) {
      table.rows.push_back(quality_row(method, compare_sets(scene, method),
                                       quality_of(thesis_pick(scene.name, method))));
    }
  }
  if (table.rows.empty()) return table;
  table.section("Mean over the scenes (thesis: over its four)");
  for (const std::string& method : evaluation.methods) {
    table.rows.push_back(
        quality_row(method, mean_comparison(evaluation, method), quality_of(thesis_mean(method))));
  }
  table.note =
      "Ratios of the picks' vox scores. production / full: 1 or more means that the small set is "
      "as good as the large one. full / production is what the thesis calls vox quality: there, "
      "lower is better.";
  return table;
}

}  // namespace vantage
