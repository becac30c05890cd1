#include "metrics/planning/shadow_filter_evaluation.hpp"

#include <fmt/format.h>

#include "metrics/planning/planning_numbers.hpp"

namespace vantage {
namespace {

/// The mean of what is there.
struct Mean {
  double sum = 0;
  std::size_t count = 0;

  void add(const std::optional<double>& value) {
    if (value) sum += *value, ++count;
  }
  std::optional<double> value() const {
    if (count == 0) return std::nullopt;
    return sum / double(count);
  }
};

std::vector<std::string> filter_cells(const ShadowFilter& filter) {
  return {fmt::format("{:g}", filter.offset_sigmas), fmt::format("{}", filter.opening_voxels),
          cm3_text(filter.min_m3)};
}

ReportTable means_table(const ShadowFilterEvaluation& evaluation, std::size_t best) {
  ReportTable table{fmt::format("False-shadow filters: means over {} scenes, voxels of {:g} mm",
                                evaluation.scenes.size(), 1e3 * evaluation.voxel_size_m),
                    {{"offset, σ"},
                     {"opening, voxels"},
                     {"regions from, cm³"},
                     {"precision"},
                     {"recall"},
                     {"F1"},
                     {"false, cm³"},
                     {"missed, cm³"}},
                    {},
                    "Shadow volume against what ideal sensors at the same poses would leave "
                    "unseen. Solid voxels, voxels outside every camera's view and voxels at the "
                    "boundary of the seen volume are not counted."};
  for (std::size_t i = 0; i < evaluation.filters.size(); ++i) {
    const FilterMeans means = means_of(evaluation, i);
    TableRow row{filter_cells(evaluation.filters[i]),
                 i == best ? RowKind::emphasis : RowKind::plain};
    for (const auto& share : {means.precision, means.recall, means.f1}) {
      row.cells.push_back(percent_text(share));
    }
    row.cells.push_back(cm3_text(means.false_m3));
    row.cells.push_back(cm3_text(means.missed_m3));
    table.rows.push_back(std::move(row));
  }
  return table;
}

TableRow scene_row(const std::string& name, const ShadowScore& score, RowKind kind) {
  return {{name, percent_text(score.precision()), percent_text(score.recall()),
           percent_text(score.f1()), cm3_text(score.true_m3), cm3_text(score.false_m3),
           cm3_text(score.missed_m3), cm3_text(score.boundary_m3)},
          kind};
}

ReportTable scenes_table(const ShadowFilterEvaluation& evaluation, std::size_t best) {
  ReportTable table{"By scene: the first filter and the best one",
                    {{"filter", "", true},
                     {"precision"},
                     {"recall"},
                     {"F1"},
                     {"true, cm³"},
                     {"false, cm³"},
                     {"missed, cm³"},
                     {"boundary, cm³"}}};
  for (const FilteredScene& scene : evaluation.scenes) {
    table.section(fmt::format("{}: {} cm³ truly hidden", scene.name, cm3_text(scene.hidden_m3)));
    table.rows.push_back(scene_row("first", scene.scores.front(), RowKind::plain));
    table.rows.push_back(scene_row("best", scene.scores.at(best), RowKind::emphasis));
  }
  return table;
}

}  // namespace

FilterMeans means_of(const ShadowFilterEvaluation& evaluation, std::size_t filter) {
  Mean precision, recall, f1, wrong, missed;
  for (const FilteredScene& scene : evaluation.scenes) {
    const ShadowScore& score = scene.scores.at(filter);
    precision.add(score.precision());
    recall.add(score.recall());
    f1.add(score.f1());
    wrong.add(score.false_m3);
    missed.add(score.missed_m3);
  }
  return {precision.value(), recall.value(), f1.value(), wrong.value().value_or(0),
          missed.value().value_or(0)};
}

std::optional<std::size_t> best_filter(const ShadowFilterEvaluation& evaluation) {
  std::optional<std::size_t> best;
  double best_f1 = -1;
  for (std::size_t i = 0; i < evaluation.filters.size(); ++i) {
    const std::optional<double> f1 = means_of(evaluation, i).f1;
    if (f1 && *f1 > best_f1) best = i, best_f1 = *f1;
  }
  return best;
}

std::vector<ReportTable> shadow_filter_tables(const ShadowFilterEvaluation& evaluation) {
  const std::size_t best = best_filter(evaluation).value_or(0);
  return {means_table(evaluation, best), scenes_table(evaluation, best)};
}

}  // namespace vantage
