#pragma once

#include <CLI/CLI.hpp>

#include "plan/plan_input.hpp"

namespace vantage {

// The command line of every verb that plans from a recording, part by part.

/// The dataset, which of its images, and the work area: by workcell file or by box.
void add_input_options(CLI::App& verb, PlanOptions& plan);

/// Where the objects come from.
void add_object_options(CLI::App& verb, ObjectSource& source);

/// How the work area is classified.
void add_volume_options(CLI::App& verb, PlanOptions& plan);

}  // namespace vantage
