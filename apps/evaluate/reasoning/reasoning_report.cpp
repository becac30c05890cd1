#include "evaluate/reasoning/reasoning_report.hpp"

#include <fmt/format.h>

#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : double(part) / double(whole);
}

Json counts_json(const ReasoningCounts& counts, const ReasoningEvaluation& evaluation) {
  return {{"min_probability", counts.min_probability},
          {"reported", counts.reported},
          {"found", counts.found},
          {"phantoms", counts.phantoms},
          {"recall", share_of(counts.found, evaluation.true_objects)},
          {"phantoms_per_scene", share_of(counts.phantoms, evaluation.scenes)}};
}

}  // namespace

Json reasoning_to_json(const ReasoningEvaluation& evaluation) {
  Json json{{"vantage", kVersion},
            {"partial", evaluation.partial},
            {"scenes", evaluation.scenes},
            {"true_objects", evaluation.true_objects},
            {"results", Json::array()}};
  for (const EvaluatedReasoning& result : evaluation.results) {
    Json counts = Json::array();
    for (const ReasoningCounts& at : result.counts) counts.push_back(counts_json(at, evaluation));
    json["results"].push_back(
        {{"method", result.method}, {"evidence", result.evidence}, {"at", counts}});
  }
  return json;
}

ReportTable reasoning_table(const ReasoningEvaluation& evaluation) {
  ReportTable table{.title = fmt::format("Phantoms and recall, {} scenes with {} visible objects",
                                         evaluation.scenes, evaluation.true_objects),
                    .columns = {{"method", "", true},
                                {"evidence", "", true},
                                {"phantoms"},
                                {"per scene"},
                                {"recall"},
                                {"recall at p > 0.9"}}};
  for (const EvaluatedReasoning& result : evaluation.results) {
    const ReasoningCounts& all = result.counts.front();
    const auto sure = std::ranges::find(result.counts, 0.9, &ReasoningCounts::min_probability);
    table.rows.push_back({{result.method, result.evidence, std::to_string(all.phantoms),
                           fmt::format("{:.4f}", share_of(all.phantoms, evaluation.scenes)),
                           fmt::format("{:.4f}", share_of(all.found, evaluation.true_objects)),
                           fmt::format("{:.4f}", share_of(sure->found, evaluation.true_objects))}});
  }
  table.note =
      "Phantoms: objects with a probability of 0.5 or more that match no true object of their type "
      "(half a diameter). Recall: of the objects of which some camera's detector found a marker.";
  return table;
}

}  // namespace vantage
