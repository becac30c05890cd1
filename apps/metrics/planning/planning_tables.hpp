#pragma once

#include <string>
#include <vector>

#include "metrics/planning/planning_evaluation.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

// The thesis' tables 9.1 to 9.6 with our figures, and the thesis' beside them where it has any.
// They contain all figures of the evaluation; a missing value is a dash.

/// The scenes: what is occupied, hidden, and truly hidden, and how many views are feasible.
ReportTable scenes_table(const PlanningEvaluation& evaluation);

/// Table 9.5: the methods' picks from a set, scene by scene, and their means.
ReportTable comparison_table(const PlanningEvaluation& evaluation, const std::string& set);

/// Table 9.6: the production set against the full one. Without both, a table without rows.
ReportTable quality_table(const PlanningEvaluation& evaluation);

/// Tables 9.1 to 9.4: the servo iterations of every method's pick from the scene's first set, and
/// what polishing made of it.
ReportTable servo_table(const SceneEvaluation& scene);

/// All tables that an evaluation has, in reading order.
std::vector<ReportTable> planning_tables(const PlanningEvaluation& evaluation);

/// Sets that were evaluated in some scene, in their order.
std::vector<std::string> sets_of(const PlanningEvaluation& evaluation);

/// Remarks on a scene, e.g. that nothing in it casts a shadow; usually none.
std::vector<std::string> remarks_on(const SceneEvaluation& scene);

}  // namespace vantage
