#include "plan/candidate_options.hpp"

#include <algorithm>
#include <vector>

#include "options/candidate_fields.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "vantage/raycore/error.hpp"
#include "workcell/view_list.hpp"
#include "workcell/workcell_views.hpp"

namespace vantage {
namespace {

bool is_name(const std::string& set) {
  return set == "production" || set == "full";
}

std::vector<const Field*> all_fields(const FieldGroup& group) {
  std::vector<const Field*> all;
  for (const Field& field : group.fields) all.push_back(&field);
  for (const FieldGroup& nested : group.nested) {
    const auto more = all_fields(nested);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// @throws Error bad_input for something given that this kind of candidates does not have.
void check_kind(const nlohmann::json& given, const FieldGroup& kind) {
  HalfSpheres spheres;
  const FieldGroup possible = fields_of(spheres);
  for (const Field* field : all_fields(possible)) {
    const auto has_option = [&](const Field* other) { return other->option == field->option; };
    if (!given.contains(field->key) || std::ranges::any_of(all_fields(kind), has_option)) continue;
    throw bad_input(field->option,
                    "the workcell's candidates do not have this setting; also give --candidates "
                    "production or full, or leave it out");
  }
}

}  // namespace

void CandidateOptions::add_to(CLI::App& verb) {
  verb.add_option("--candidates", set,
                  "Views to choose from; production: 20 on each of two half-spheres that look at "
                  "the centre; full: 34,225, 1,369 positions on three half-spheres with 25 "
                  "directions each; or a file of views, see assets/schema/views.schema.json "
                  "(default: the workcell's, or production)")
      ->option_text("production|full|FILE")
      ->group("Candidates");
  HalfSpheres spheres = production_views();
  ViewConstraints constraints;
  add_fields(verb, {"", "Candidates", {}, {body_fields(constraints), fields_of(spheres)}}, given);
}

CandidateSet CandidateOptions::resolve(const Workcell& workcell) const {
  const nlohmann::json fields = given.value("candidates", nlohmann::json::object());
  CandidateSet candidates = workcell.candidates;
  if (is_name(set)) {
    const HalfSpheres* own = std::get_if<HalfSpheres>(&workcell.candidates);
    std::vector<double> radii_m = own != nullptr ? own->radii_m : std::vector<double>();
    if (fields.contains("radii_m")) radii_m = fields["radii_m"].get<std::vector<double>>();
    candidates = half_spheres_of(set, radii_m);
  } else if (!set.empty()) {
    candidates = ViewList{read_view_file(set)};
  }
  const FieldGroup kind = fields_of(candidates);
  check_kind(fields, kind);
  read_given(fields, kind);
  return candidates;
}

void CandidateOptions::apply(Workcell& workcell) const {
  workcell.candidates = resolve(workcell);
  if (!set.empty() && !is_name(set)) workcell.files.push_back(set);
  read_given(given, body_fields(workcell.constraints));
}

}  // namespace vantage
