#include "plan/candidate_options.hpp"

#include <numbers>

#include "cli/number_checks.hpp"
#include "vantage/raycore/error.hpp"
#include "workcell/view_list.hpp"
#include "workcell/workcell_views.hpp"

namespace vantage {
namespace {

bool is_name(const std::string& set) {
  return set == "production" || set == "full";
}

/// The set without the options that change it.
CandidateSet chosen(const CandidateOptions& options, const Workcell& workcell) {
  const HalfSpheres* spheres = std::get_if<HalfSpheres>(&workcell.candidates);
  if (is_name(options.set)) {
    const bool keeps_radii = options.radii_m.empty() && spheres != nullptr;
    return half_spheres_of(options.set, keeps_radii ? spheres->radii_m : options.radii_m);
  }
  if (!options.set.empty()) return ViewList{read_view_file(options.set)};
  return workcell.candidates;
}

[[noreturn]] void refuse(const char* option, const char* needs) {
  throw bad_input(option, std::string("the candidates are ") + needs +
                              "; give --candidates production or full, too, or leave this out");
}

}  // namespace

void CandidateOptions::add_to(CLI::App& verb) {
  verb.add_option("--candidates", set,
                  "Views to choose from; production: 20 on each of two half-spheres that look at "
                  "the centre; full: 34,225, 1,369 positions on three half-spheres with 25 "
                  "directions each; or a file of views, see assets/schema/views.schema.json "
                  "(default: the workcell's, or production)");
  verb.add_option("--radii", radii_m,
                  "Radii of the half-spheres, metres, e.g. 0.6,0.9 (default: from the work area)")
      ->delimiter(',')
      ->check(positive_number());
  verb.add_option("--count", counts,
                  "Positions on each half-sphere: one number, or one for each, e.g. 20,40")
      ->delimiter(',')
      ->check(positive_number());
  verb.add_option("--rings", rings,
                  "Rings of further directions at each position: 8 in the first, 16 in the next …")
      ->check(CLI::Range(0, 50));
  verb.add_option("--ring-step", ring_step_rad, "Angle from ring to ring, radians (default: 0.175)")
      ->check(number_between(1e-6, std::numbers::pi));
  verb.add_option(
          "--clearance", clearance_m,
          "Least distance of the camera's body from the floor and everything occupied, metres "
          "(default: 0)")
      ->check(number_from_zero());
}

CandidateSet CandidateOptions::resolve(const Workcell& workcell) const {
  CandidateSet candidates = chosen(*this, workcell);
  HalfSpheres* spheres = std::get_if<HalfSpheres>(&candidates);
  BoxGrid* grid = std::get_if<BoxGrid>(&candidates);
  if (spheres == nullptr && !radii_m.empty()) refuse("--radii", "no half-spheres");
  if (spheres == nullptr && !counts.empty()) refuse("--count", "no half-spheres");
  if (!radii_m.empty()) spheres->radii_m = radii_m;
  if (!counts.empty()) spheres->counts = counts;

  ViewFan* fan = spheres != nullptr ? &spheres->fan : grid != nullptr ? &grid->fan : nullptr;
  if (fan == nullptr && rings) refuse("--rings", "whole poses");
  if (fan == nullptr && ring_step_rad) refuse("--ring-step", "whole poses");
  if (rings) fan->rings = *rings;
  if (ring_step_rad) fan->step_rad = *ring_step_rad;
  return candidates;
}

void CandidateOptions::apply(Workcell& workcell) const {
  workcell.candidates = resolve(workcell);
  if (!set.empty() && !is_name(set)) workcell.files.push_back(set);
  if (clearance_m) workcell.constraints.clearance_m = *clearance_m;
}

}  // namespace vantage
