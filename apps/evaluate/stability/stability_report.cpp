#include "evaluate/stability/stability_report.hpp"

#include <fmt/format.h>

#include "cli/units.hpp"
#include "evaluate/optional_json.hpp"
#include "reconstruct/support/support_json.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kFaultNames{"none", "removed", "shifted"};

std::optional<double> share_right(const StackVerdicts& verdicts) {
  if (verdicts.judged == 0) return {};
  return double(verdicts.right) / double(verdicts.judged);
}

Json verdicts_json(const StackVerdicts& verdicts) {
  Json json{{"judged", verdicts.judged},
            {"right", verdicts.right},
            {"share", or_null(share_right(verdicts))},
            {"incomplete", verdicts.incomplete},
            {"objects", Json::object()}};
  for (std::size_t v = 0; v < verdicts.objects.size(); ++v) {
    json["objects"][verdict_name(SupportVerdict(v))] = verdicts.objects[v];
  }
  return json;
}

Json sums_json(const RestingErrors::Sums& sums, std::size_t objects) {
  if (objects == 0) return nullptr;
  const double n = double(objects);
  return {{"translation_mm", sums.translation_m / n * kMillimetres},
          {"rotation_deg", sums.rotation_rad / n * kDegrees},
          {"nees", sums.nees / n}};
}

Json resting_json(const RestingErrors& errors) {
  return {{"objects", errors.objects},
          {"flagged", errors.flagged},
          {"pulled", errors.pulled},
          {"before", sums_json(errors.before, errors.objects)},
          {"after", sums_json(errors.after, errors.objects)}};
}

TableRow verdict_row(const std::string& name, const StackVerdicts& verdicts) {
  const auto share = share_right(verdicts);
  return {{name, fmt::format("{}", verdicts.judged), fmt::format("{}", verdicts.right),
           share ? fmt::format("{:.1f} %", 100 * *share) : "-",
           fmt::format("{}", verdicts.incomplete)}};
}

void add_rows(const std::string& name, const RestingErrors& errors, ReportTable& table) {
  if (errors.objects == 0) return;
  const double n = double(errors.objects);
  const auto row = [&](const std::string& what, double before, double after) {
    table.rows.push_back({{fmt::format("{}, {}", name, what), fmt::format("{:.3f}", before / n),
                           fmt::format("{:.3f}", after / n)}});
  };
  row("translation (mm)", errors.before.translation_m * kMillimetres,
      errors.after.translation_m * kMillimetres);
  row("rotation (deg)", errors.before.rotation_rad * kDegrees,
      errors.after.rotation_rad * kDegrees);
  row("NEES (6 if covariances are exact)", errors.before.nees, errors.after.nees);
  table.rows.push_back({{fmt::format("{}, pulled of objects", name), "",
                         fmt::format("{} of {}", errors.pulled, errors.objects)}});
  table.rows.push_back(
      {{fmt::format("{}, said not to stand", name), "", fmt::format("{}", errors.flagged)}});
}

}  // namespace

Json stability_to_json(const StabilityEvaluation& evaluation) {
  Json stacks{{"all", verdicts_json(evaluation.all_stacks())}};
  for (std::size_t f = 0; f < kFaultNames.size(); ++f) {
    stacks[kFaultNames[f]] = verdicts_json(evaluation.stacks[f]);
  }
  return {{"vantage", kVersion},
          {"partial", evaluation.partial},
          {"stacks", stacks},
          {"at_rest",
           {{"in_stacks", resting_json(evaluation.in_stacks)},
            {"in_scenes", resting_json(evaluation.in_scenes)}}}};
}

std::vector<ReportTable> stability_tables(const StabilityEvaluation& evaluation) {
  ReportTable verdicts{"Verdicts on stacks",
                       {{"fault", "", true}, {"judged"}, {"right"}, {"share"}, {"incomplete"}}};
  for (std::size_t f = 0; f < kFaultNames.size(); ++f) {
    verdicts.rows.push_back(verdict_row(kFaultNames[f], evaluation.stacks[f]));
  }
  verdicts.rows.push_back(verdict_row("all", evaluation.all_stacks()));
  verdicts.rows.back().kind = RowKind::emphasis;
  verdicts.note = "Incomplete stacks, of which an object was not found, are not judged.";
  ReportTable errors{"Objects at rest: mean errors",
                     {{"", "", true}, {"reconstructed"}, {"pulled to contact"}}};
  add_rows("stacks", evaluation.in_stacks, errors);
  add_rows("scenes", evaluation.in_scenes, errors);
  return {verdicts, errors};
}

}  // namespace vantage
