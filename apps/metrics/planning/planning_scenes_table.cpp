#include "metrics/planning/planning_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrics/planning/planning_numbers.hpp"
#include "metrics/plot/run_summary.hpp"

namespace vantage {
namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string median_text(const std::vector<double>& seconds) {
  const auto spread = spread_of(seconds);
  return time_text(spread ? std::optional(spread->median) : std::nullopt);
}

}  // namespace

std::vector<std::string> sets_of(const PlanningEvaluation& evaluation) {
  std::vector<std::string> sets;
  for (const SceneEvaluation& scene : evaluation.scenes) {
    for (const SetEvaluation& set : scene.sets) {
      if (std::ranges::find(sets, set.set) == sets.end()) sets.push_back(set.set);
    }
  }
  return sets;
}

std::vector<std::string> remarks_on(const SceneEvaluation& scene) {
  std::vector<std::string> remarks;
  if (scene.shadow_voxels == 0) {
    remarks.push_back(
        fmt::format("{}: no shadow at all. The known objects hide nothing from these cameras, so "
                    "methods that rely on known objects cannot suggest a view (as in the thesis' "
                    "figure 9.14); depth images show what foreign objects hide: +ideal or +noisy.",
                    scene.name));
  } else if (scene.truly_hidden_m3 > 2 * scene.shadow_m3()) {
    remarks.push_back(
        fmt::format("{}: {} cm³ are truly hidden, but only {} cm³ of that can be inferred: the "
                    "rest is hidden by unknown objects.",
                    scene.name, cm3_text(scene.truly_hidden_m3), cm3_text(scene.shadow_m3())));
  }
  for (const SetEvaluation& set : scene.sets) {
    if (set.feasible > 0) continue;
    remarks.push_back(fmt::format("{}: none of the {} views of the {} set is feasible.", scene.name,
                                  count_text(set.views), set.set));
  }
  return remarks;
}

ReportTable scenes_table(const PlanningEvaluation& evaluation) {
  ReportTable table{"Scenes",
                    {{"scene", "", true},
                     {"cameras", "", true},
                     {"depth", "", true},
                     {"voxel mm"},
                     {"occupied", "volume, cm³"},
                     {"shadow", "volume, cm³"},
                     {"truly hidden", "volume, cm³"},
                     {"shadow voxels"},
                     {"feasible views", "", true},
                     {"classify"}}};
  for (const SceneEvaluation& scene : evaluation.scenes) {
    std::vector<std::string> views;
    for (const SetEvaluation& set : scene.sets) {
      views.push_back(fmt::format("{} of {}", count_text(set.feasible), count_text(set.views)));
    }
    table.rows.push_back(
        {{scene.name, joined(scene.cameras), scene.depth,
          fmt::format("{:.4g}", 1000 * scene.voxel_size_m),
          cm3_text(double(scene.occupied_voxels) * scene.voxel_m3()), cm3_text(scene.shadow_m3()),
          cm3_text(scene.truly_hidden_m3), count_text(scene.shadow_voxels), joined(views),
          median_text(scene.classify_s)}});
  }
  table.note =
      "Shadow: neither occupied nor seen, judging by known objects and depth images; either hidden "
      "or outside every camera's view. Truly hidden: the same with all objects that are really "
      "there.";
  return table;
}

}  // namespace vantage
