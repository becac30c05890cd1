#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "workcell/workcell.hpp"

namespace vantage {

/// What the command line says of the views to choose from, and of where the camera may be. It
/// overrides the workcell.
struct CandidateOptions {
  std::string set;  ///< production, full, or a file of views; empty: the workcell's
  nlohmann::json given = nlohmann::json::object();  ///< fields of the candidates and constraints

  /// This object has to outlive the parsing.
  void add_to(CLI::App& verb);

  /// Puts them into a workcell. A named set keeps the radii of the workcell's half-spheres.
  /// @throws Error bad_input for options that do not go with the workcell's kind of candidates, and
  /// for a file as `read_view_file` does.
  void apply(Workcell& workcell) const;

 private:
  CandidateSet resolve(const Workcell& workcell) const;
};

}  // namespace vantage
