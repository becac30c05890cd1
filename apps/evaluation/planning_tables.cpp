#include "evaluation/planning_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "evaluation/planning_numbers.hpp"
#include "evaluation/run_summary.hpp"
#include "evaluation/thesis_planning.hpp"

namespace vantage {
namespace {

constexpr const char* kNone = "–";

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string median_text(const std::vector<double>& seconds) {
  const auto spread = spread_of(seconds);
  return time_text(spread ? std::optional(spread->median) : std::nullopt);
}

/// "full set: 34,225 views each, servo 5"
std::string set_title(const PlanningEvaluation& evaluation, const std::string& set) {
  for (const SceneEvaluation& scene : evaluation.scenes) {
    for (const SetEvaluation& one : scene.sets) {
      if (one.set != set) continue;
      return fmt::format("{} set, {} views, servo {}", set, count_text(one.views),
                         evaluation.servo_iterations);
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

std::string ratio_pair(double quality, const char* format) {
  return fmt::format(fmt::runtime(format), quality);
}

TableRow quality_row(const std::string& method, const std::optional<SetComparison>& ours,
                     const std::optional<double>& thesis_quality,
                     const std::optional<std::pair<double, double>>& thesis_s) {
  TableRow row{{method}};
  if (ours) {
    row.cells.insert(
        row.cells.end(),
        {ratio_pair(ours->production_share, "{:.4f}"), ratio_pair(ours->vox_quality, "{:.4f}"),
         time_text(ours->full_s) + " → " + time_text(ours->production_s),
         times_text(ours->speed_up())});
  } else {
    row.cells.insert(row.cells.end(), {kNone, kNone, kNone, kNone});
  }
  if (thesis_quality && thesis_s) {
    row.cells.insert(row.cells.end(),
                     {ratio_pair(*thesis_quality, "{:.2f}"),
                      time_text(thesis_s->first) + " → " + time_text(thesis_s->second),
                      times_text(thesis_s->first / thesis_s->second)});
  } else {
    row.cells.insert(row.cells.end(), {kNone, kNone, kNone});
  }
  return row;
}

void append_steps(ReportTable& table, const SceneEvaluation& scene, const MethodRun& run) {
  const ThesisServo* const thesis = thesis_servo(scene.name, run.method);
  const std::string printed = thesis ? fmt::format("; thesis: table {}", thesis->table) : "";
  table.section(fmt::format("{} (score in {}{})", run.method, run.unit, printed));
  for (std::size_t i = 0; i < run.pick->steps.size(); ++i) {
    const PickStep& step = run.pick->steps[i];
    TableRow row{{std::to_string(i), step.move, score_text(step.worth.method_score),
                  cm3_text(step.worth.vox_score_m3), percent_text(vox_ratio(scene, step.worth)),
                  cm3_text(step.worth.true_gain_m3)},
                 i == run.pick->best_step ? RowKind::emphasis : RowKind::plain};
    if (thesis != nullptr && i < thesis->steps.size()) {
      const ThesisStep& theirs = thesis->steps[i];
      row.cells.insert(row.cells.end(),
                       {score_text(theirs.method_score), thesis_cm3_text(theirs.vox_score_m3),
                        percent_text(theirs.vox_ratio)});
    } else {
      row.cells.insert(row.cells.end(), {"", "", ""});
    }
    table.rows.push_back(row);
  }
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
    remarks.push_back(fmt::format(
        "{}: no shadow at all. What is known there hides nothing from these cameras, so that no "
        "method that goes by the known objects can suggest a view (as the thesis' figure 9.14 "
        "has it); depth images show what foreign objects hide: +ideal or +noisy.",
        scene.name));
  } else if (scene.truly_hidden_m3 > 2 * scene.shadow_m3()) {
    remarks.push_back(fmt::format(
        "{}: {} cm³ are truly hidden, but only {} cm³ of it can be known of: the rest is hidden "
        "by what nobody knows.",
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
      "Shadow: neither occupied nor seen, as far as known objects and depth images tell; unknown "
      "to the cameras because it is hidden or in no camera's view. Truly hidden: the same with "
      "everything that really stands there.";
  return table;
}

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
      "best of all these views and their servo iterations would have seen. Run time: from a "
      "classified grid to the answer.";
  return table;
}

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
      const ThesisPick* const thesis = thesis_pick(scene.name, method);
      table.rows.push_back(
          thesis ? quality_row(method, compare_sets(scene, method), thesis->vox_quality,
                               std::pair(thesis->run_time_s, thesis->production_run_time_s))
                 : quality_row(method, compare_sets(scene, method), {}, {}));
    }
  }
  if (table.rows.empty()) return table;
  table.section("Mean over the scenes (thesis: over its four)");
  for (const std::string& method : evaluation.methods) {
    const ThesisMean* const thesis = thesis_mean(method);
    table.rows.push_back(
        thesis ? quality_row(method, mean_comparison(evaluation, method), thesis->vox_quality,
                             std::pair(thesis->run_time_s, thesis->production_run_time_s))
               : quality_row(method, mean_comparison(evaluation, method), {}, {}));
  }
  table.note =
      "Quotients of the picks' vox scores. production / full: 1 or more means that the few views "
      "are as good as the many. full / production is what the thesis calls vox quality: there, "
      "less is better.";
  return table;
}

ReportTable servo_table(const SceneEvaluation& scene) {
  ReportTable table{fmt::format("Servo iterations of the picks, {}{}", scene.name,
                                scene.sets.empty() ? "" : ", " + scene.sets.front().set + " set"),
                    {{"iteration"},
                     {"move", "", true},
                     {"method score"},
                     {"vox score cm³"},
                     {"vox ratio"},
                     {"true gain cm³"},
                     {"method score", "thesis"},
                     {"vox score cm³", "thesis"},
                     {"vox ratio", "thesis"}}};
  if (scene.sets.empty()) return table;
  for (const MethodRun& run : scene.sets.front().runs) {
    if (run.pick) append_steps(table, scene, run);
  }
  table.note =
      "Marked: the iteration with the best method score, which is the pick. The thesis' method "
      "scores are of its own scenes and images.";
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
