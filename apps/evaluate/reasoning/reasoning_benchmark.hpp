#pragma once

#include <string>
#include <vector>

#include "evaluate/reasoning/reasoning_scene.hpp"
#include "reconstruct/scene_reconstruction.hpp"

namespace vantage {

struct ReasoningBenchmarkOptions {
  int scenes = 500;
  std::uint64_t seed = 1;  ///< of the first scene; the next has the next one
  FeatureSensor sensor = {};
  Perturbation perturbation = {.drop = 0.2, .wrong_ids = 0.05};  ///< its seed is the scene's
  std::vector<ReconstructionMethod> methods = {ReconstructionMethod::pnp};
};

/// What is reported with at least some probability, held against the truth.
struct ReasoningCounts {
  double min_probability = 0.5;
  std::size_t reported = 0;
  std::size_t found = 0;     ///< true objects, of those that a camera saw
  std::size_t phantoms = 0;  ///< reported, but no true object of the type is there
};

/// What of the scene's evidence was looked at, and what came of it.
struct EvaluatedReasoning {
  std::string method;
  std::string evidence;                 ///< e.g. "all", "without depth"
  std::vector<ReasoningCounts> counts;  ///< ascending by `min_probability`
};

struct ReasoningEvaluation {
  std::size_t scenes = 0;        ///< that are complete
  std::size_t true_objects = 0;  ///< that a camera saw
  bool partial = false;          ///< stopped before all were
  std::vector<EvaluatedReasoning> results;
};

/// Reconstructs seeded random scenes of a workcell, with features that are found by rays, dropped
/// and misread, and weighs what was found by all of the scene's evidence, and by all but one kind.
/// In the caller's task arena; the same result at any number of threads.
/// @throws Error bad_input as `reasoning_scene` does.
ReasoningEvaluation evaluate_reasoning(const Workcell& workcell,
                                       const ReasoningBenchmarkOptions& options,
                                       const StopToken& stop = {});

}  // namespace vantage
