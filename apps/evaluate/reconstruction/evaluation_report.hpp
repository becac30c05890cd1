#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "evaluate/reconstruction/reconstruction_evaluation.hpp"

namespace vantage {

/// reconstruction.json, as assets/schema/evaluation.schema.json describes it; `config` and `inputs`
/// are the caller's to add. The same bytes for the same evaluation: no times are in it.
nlohmann::ordered_json evaluation_to_json(const ReconstructionEvaluation& evaluation);

/// A table for people.
std::string summary_of_evaluation(const ReconstructionEvaluation& evaluation);

/// reconstruction.svg: errors over the number of cameras, as the thesis' figure 8.2 has them.
std::string plot_of_evaluation(const ReconstructionEvaluation& evaluation,
                               const std::string& title);

}  // namespace vantage
