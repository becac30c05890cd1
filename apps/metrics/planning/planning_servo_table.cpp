#include "metrics/planning/planning_tables.hpp"

#include <fmt/format.h>

#include "metrics/planning/planning_numbers.hpp"
#include "metrics/planning/thesis_planning.hpp"

namespace vantage {
namespace {

void append_steps(ReportTable& table, const SceneEvaluation& scene, const MethodRun& run) {
  const ThesisServo* const thesis = thesis_servo(scene.name, run.method);
  const std::string printed = thesis ? fmt::format("; thesis: table {}", thesis->table) : "";
  table.section(fmt::format("{} (score in {}{})", run.method, run.unit, printed));
  for (std::size_t i = 0; i < run.pick->steps.size(); ++i) {
    const PickStep& step = run.pick->steps[i];
    const bool servo = step.move != "polish";
    TableRow row{{servo ? std::to_string(i) : "–", step.move, score_text(step.worth.method_score),
                  cm3_text(step.worth.vox_score_m3), percent_text(vox_ratio(scene, step.worth)),
                  cm3_text(step.worth.true_gain_m3)},
                 i == run.pick->best_step ? RowKind::emphasis : RowKind::plain};
    if (servo && thesis != nullptr && i < thesis->steps.size()) {
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
      "Marked: the step with the best method score, which is the pick. Polishing, which is not in "
      "the thesis, continues from the best iteration. The thesis' method scores are for its own "
      "scenes and images.";
  return table;
}

}  // namespace vantage
