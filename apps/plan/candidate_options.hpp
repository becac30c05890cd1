#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "workcell/workcell.hpp"

namespace vantage {

/// What the command line says of the views to choose from, and of where the camera may be. It wins
/// over the workcell.
struct CandidateOptions {
  std::string set;              ///< production, full, or a file of views; empty: the workcell's
  std::vector<double> radii_m;  ///< empty: the workcell's
  std::vector<int> counts;      ///< empty: the workcell's, or the set's
  std::optional<int> rings;
  std::optional<double> ring_step_rad;
  std::optional<double> clearance_m;

  void add_to(CLI::App& verb);

  /// Puts them into a workcell. A named set keeps the radii of the workcell's half-spheres.
  /// @throws Error bad_input for options that do not go with the workcell's kind of candidates, and
  /// for a file as `read_view_file` does.
  void apply(Workcell& workcell) const;

  /// The candidates alone.
  CandidateSet resolve(const Workcell& workcell) const;
};

}  // namespace vantage
