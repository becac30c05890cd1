#include <fmt/format.h>

#include "cli/units.hpp"
#include "evaluate/reconstruction/evaluation_report.hpp"
#include "metrics/plot/error_plot.hpp"

namespace vantage {
namespace {

using SpreadOf = std::optional<Spread> RunSummary::*;

std::string mean_and_deviation(const std::optional<Spread>& spread, double scale) {
  if (!spread) return "–";
  return fmt::format("{:.3g} ± {:.2g}", spread->mean * scale, spread->deviation * scale);
}

std::string mean_text(const std::vector<double>& values) {
  const std::optional<Spread> spread = spread_of(values);
  return spread ? fmt::format("{:.3g}", spread->mean) : "–";
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f}", 100 * *share) : "–";
}

std::string row(const std::string& method, const std::string& cameras, const RunSummary& summary) {
  return fmt::format("{:<8}{:>8}{:>7}{:>18}{:>18}{:>18}{:>20}{:>10}{:>13}\n", method, cameras,
                     summary.runs, mean_and_deviation(summary.translation_m, kMillimetres),
                     mean_and_deviation(summary.rotation_rad, kDegrees),
                     mean_and_deviation(summary.mssd_m, kMillimetres),
                     mean_and_deviation(summary.self_consistency_mm2, 1), percent(summary.recall),
                     percent(summary.precision));
}

std::string bop_line(const MethodEvaluation& method) {
  if (!method.bop) return "";
  const BopScores& bop = *method.bop;
  std::vector<double> add, add_s;
  for (const EstimateErrors& errors : method.errors) {
    add.push_back(errors.add_m * kMillimetres);
    add_s.push_back(errors.add_s_m * kMillimetres);
  }
  return fmt::format("{:<8} AR {} % (VSD {}, MSSD {}, MSPD {}), ADD {} mm, ADD-S {} mm\n",
                     method.name, percent(bop.average_recall()), percent(bop.ar_vsd),
                     percent(bop.ar_mssd), percent(bop.ar_mspd), mean_text(add), mean_text(add_s));
}

/// As the thesis calls the methods.
std::string title_of(const std::string& method) {
  if (method == "svd") return "SVD";
  return method == "pnp" ? "multi-view PnP" : method;
}

PlotPanel panel_of(const ReconstructionEvaluation& evaluation, const char* title, const char* unit,
                   SpreadOf error, double scale) {
  PlotPanel panel{title, unit, {}};
  for (const MethodEvaluation& method : evaluation.methods) {
    PlotSeries series{title_of(method.name), {}};
    for (const auto& [cameras, summary] : method.by_cameras) {
      const std::optional<Spread>& spread = summary.*error;
      if (!spread) continue;
      series.points.push_back({int(cameras), spread->mean * scale, spread->deviation * scale});
    }
    panel.series.push_back(series);
  }
  return panel;
}

}  // namespace

std::string summary_of_evaluation(const ReconstructionEvaluation& evaluation) {
  std::string text =
      fmt::format("{} true objects, {} cameras, {} subsets, {} runs\n\n", evaluation.truth.size(),
                  evaluation.images.size(), evaluation.subsets.size(), evaluation.runs.size());
  text += fmt::format("{:<8}{:>8}{:>7}{:>18}{:>18}{:>18}{:>20}{:>10}{:>13}\n", "method", "cameras",
                      "runs", "translation mm", "rotation °", "MSSD mm", "consistency mm²",
                      "recall %", "precision %");
  for (const MethodEvaluation& method : evaluation.methods) {
    for (const auto& [cameras, summary] : method.by_cameras) {
      text += row(method.name, std::to_string(cameras), summary);
    }
    text += row(method.name, "all", method.all) + "\n";
  }
  text += "BOP scores, all cameras, no perturbation:\n";
  for (const MethodEvaluation& method : evaluation.methods) text += bop_line(method);
  return text;
}

std::string plot_of_evaluation(const ReconstructionEvaluation& evaluation,
                               const std::string& title) {
  std::vector<PlotPanel> panels{panel_of(evaluation, "Translation", "error against the truth, mm",
                                         &RunSummary::translation_m, kMillimetres),
                                panel_of(evaluation, "Rotation", "error against the truth, degrees",
                                         &RunSummary::rotation_rad, kDegrees)};
  if (evaluation.touching_pairs > 0) {
    panels.push_back(panel_of(evaluation, "Self-consistency", "squared distances of corners, mm²",
                              &RunSummary::self_consistency_mm2, 1));
  }
  return error_plot_svg(title, "cameras", panels);
}

}  // namespace vantage
