#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "plan/run_plan.hpp"

namespace vantage {

/// Options of all verbs that plan.
struct CommonOptions {
  OutputOptions output;
  int threads = 0;
  std::optional<double> deadline_ms;

  void add_to(CLI::App& verb);

  /// The deadline counts from `start`.
  RunOptions run(StopToken::Clock::time_point start) const;
};

}  // namespace vantage
