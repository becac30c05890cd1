#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "metrics/reconstruction/camera_subsets.hpp"
#include "metrics/reconstruction/perturbation.hpp"
#include "metrics/reconstruction/reconstruction_evaluator.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// A way to reconstruct a scene. Called from many threads at once.
struct EvaluatedMethod {
  std::string name;
  std::function<Reconstruction(std::span<const CameraView>)> reconstruct;
};

/// What to run.
struct SubsetPlan {
  std::vector<CameraSubset> subsets;
  Perturbation perturbation = {};
  std::size_t trials = 1;                ///< of the perturbation, for each subset
  std::vector<FeatureKey> keys = {};     ///< see `disturbed`
  std::vector<FeatureKey> ignored = {};  ///< observations with these are left out after disturbing
};

/// All methods with the cameras of one subset, in one trial.
struct SubsetRun {
  std::size_t subset = 0, trial = 0;
  std::vector<ReconstructionScore> scores;  ///< one for each method
};

/// Runs every method on every subset in every trial, in the caller's task arena. An object is to be
/// found if a camera of the subset sees it (`seen_objects`, before anything is disturbed).
/// @returns runs in the order of subsets, then of trials, at any number of threads; the result is
/// meaningless if `stop` was cancelled.
std::vector<SubsetRun> evaluate_subsets(std::span<const CameraView> views,
                                        const ReconstructionEvaluator& evaluator,
                                        std::span<const EvaluatedMethod> methods,
                                        const SubsetPlan& plan, const StopToken& stop = {});

/// The subsets that see every object that all cameras together see.
std::vector<CameraSubset> covering_subsets(std::span<const CameraView> views,
                                           std::span<const TrueObject> truth,
                                           std::span<const CameraSubset> subsets);

}  // namespace vantage
