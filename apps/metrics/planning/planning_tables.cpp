#include "metrics/planning/planning_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrics/planning/planning_numbers.hpp"
#include "metrics/planning/thesis_planning.hpp"

namespace vantage {
namespace {

/// "full set, 34,225 views, servo 5, 2 polished"
std::string set_title(const PlanningEvaluation& evaluation, const std::string& set) {
  for (const SceneEvaluation& scene : evaluation.scenes) {
    for (const SetEvaluation& one : scene.sets) {
      if (one.set != set) continue;
      const std::string title = fmt::format("{} set, {} views, servo {}", set,
                                            count_text(one.views), evaluation.servo_iterations);
      if (evaluation.polished_views == 0) return title;
      return fmt::format("{}, {} polished", title, evaluation.polished_views);
    }
  }
  return set + " set";
}

std::vector<std::string> comparison_row(const SceneEvaluation& scene, const SetEvaluation& set,
                                        const MethodRun& run) {
  std::vector<std::string> cells{run.method};
  if (run.pick) {
    const PoseWorth& worth = run.pick->worth();
    cells.insert(cells.end(), {score_text(worth.method_score), cm3_text(worth.vox_score_m3),
                               percent_text(vox_ratio(scene, worth))});
  } else {
    cells.insert(cells.end(), {kNone, kNone, kNone});
  }
  cells.push_back(time_text(median_run_time_s(run)));
  cells.push_back(run.pick ? cm3_text(run.pick->worth().true_gain_m3) : kNone);
  cells.push_back(cm3_text(regret_m3(set, run)));
  return cells;
}

/// The thesis' vox score, vox ratio and run time.
void append_thesis(std::vector<std::string>& cells, const SceneEvaluation& scene,
                   const std::string& method, bool full) {
  const ThesisPick* const thesis = thesis_pick(scene.name, method);
  if (thesis == nullptr) {
    cells.insert(cells.end(), {kNone, kNone, kNone});
    return;
  }
  // Of the smaller set, the thesis prints the quotient only.
  const double vox = full ? thesis->vox_score_m3 : thesis->vox_score_m3 / thesis->vox_quality;
  const double ratio = full ? thesis->vox_ratio : thesis->vox_ratio / thesis->vox_quality;
  const double time = full ? thesis->run_time_s : thesis->production_run_time_s;
  cells.insert(cells.end(), {thesis_cm3_text(vox), percent_text(ratio), time_text(time)});
}

TableRow mean_row(const PlanningEvaluation& evaluation, const std::string& set,
                  const std::string& method) {
  const MethodMeans means = means_of(evaluation, set, method);
  TableRow row{{method, "", "", percent_text(means.vox_ratio), time_text(means.run_time_s),
                cm3_text(means.true_gain_m3), cm3_text(means.regret_m3), ""}};
  const ThesisMean* const thesis = thesis_mean(method);
  if (thesis == nullptr) {
    row.cells.insert(row.cells.end(), {kNone, kNone});
  } else if (set == "full") {
    row.cells.insert(row.cells.end(),
                     {percent_text(thesis->vox_ratio), time_text(thesis->run_time_s)});
  } else {
    row.cells.insert(row.cells.end(), {kNone, time_text(thesis->production_run_time_s)});
  }
  return row;
}

}  // namespace

ReportTable comparison_table(const PlanningEvaluation& evaluation, const std::string& set) {
  const bool full = set == "full";
  ReportTable table{fmt::format("Methods compared: {} (thesis: {})", set_title(evaluation, set),
                                full ? "table 9.5" : "tables 9.5 and 9.6"),
                    {{"method", "", true},
                     {"method score"},
                     {"vox score cm³"},
                     {"vox ratio"},
                     {"run time"},
                     {"true gain cm³"},
                     {"true regret cm³"},
                     {"vox score cm³", "thesis"},
                     {"vox ratio", "thesis"},
                     {"run time", "thesis"}}};
  for (const SceneEvaluation& scene : evaluation.scenes) {
    const auto found = std::ranges::find(scene.sets, set, &SetEvaluation::set);
    if (found == scene.sets.end()) continue;
    const ThesisPick* const thesis = thesis_pick(scene.name, "voxel");
    table.section(scene.name + (thesis ? fmt::format(" (thesis: {})", thesis->title) : ""));
    for (const MethodRun& run : found->runs) {
      TableRow row{comparison_row(scene, *found, run)};
      append_thesis(row.cells, scene, run.method, full);
      table.rows.push_back(row);
    }
  }
  table.section("Mean over the scenes (thesis: over its four)");
  for (const std::string& method : evaluation.methods) {
    table.rows.push_back(mean_row(evaluation, set, method));
  }
  table.note =
      "Vox score: shadow that the view would reveal by the voxel method. Vox ratio: by the vox "
      "score of the voxel method's pick" +
      std::string(full ? "" : " from the first set") +
      ". True gain: truly hidden volume that the view really sees; true regret: how much more the "
      "best known view would have seen, which is the best of all these views and their servo "
      "iterations, polished by what they really see, and of the picks. Run time: from a classified "
      "grid to the answer.";
  return table;
}

std::vector<ReportTable> planning_tables(const PlanningEvaluation& evaluation) {
  std::vector<ReportTable> tables{scenes_table(evaluation)};
  for (const std::string& set : sets_of(evaluation)) {
    tables.push_back(comparison_table(evaluation, set));
  }
  const ReportTable quality = quality_table(evaluation);
  if (!quality.rows.empty()) tables.push_back(quality);
  for (const SceneEvaluation& scene : evaluation.scenes) {
    const ReportTable servo = servo_table(scene);
    if (!servo.rows.empty()) tables.push_back(servo);
  }
  return tables;
}

}  // namespace vantage
