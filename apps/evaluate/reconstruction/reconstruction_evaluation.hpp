#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrics/plot/run_summary.hpp"
#include "metrics/reconstruction/bop_scores.hpp"
#include "reconstruct/scene_reconstruction.hpp"

namespace vantage {

/// What `vantage evaluate reconstruction` was asked for.
struct ReconstructionEvaluationOptions {
  std::vector<ReconstructionMethod> methods = {};
  ObserveOptions observe = {};
  ReconstructOptions reconstruct = {};
  std::size_t min_cameras = 2;
  std::optional<std::size_t> max_cameras = {};  ///< none: all that are located
  bool covering = false;                        ///< only subsets that see every object
  Perturbation perturbation = {};
  std::size_t trials = 1;
  double correct = 0.1;  ///< MSSD in diameters below which an estimate is correct
};

/// A camera as it was located, and its pose in the dataset.
struct EvaluatedCamera {
  int image = 0;
  std::string reason = {};       ///< why it was not located, and is left out
  std::size_t observations = 0;  ///< of objects
  std::optional<double> translation_error_m = {}, rotation_error_rad = {};
};

/// One method over everything.
struct MethodEvaluation {
  std::string name;
  std::map<std::size_t, RunSummary> by_cameras;
  RunSummary all;
  Reconstruction from_all_cameras;     ///< without perturbation
  std::vector<EstimateErrors> errors;  ///< its
  std::optional<BopScores> bop;        ///< its
};

struct ReconstructionEvaluation {
  std::vector<TrueObject> truth;
  std::size_t touching_pairs = 0;
  std::vector<EvaluatedCamera> cameras;  ///< all of the dataset
  std::vector<int> images;               ///< of the cameras that subsets have, by their index
  std::vector<CameraSubset> subsets;
  std::vector<SubsetRun> runs;
  std::vector<MethodEvaluation> methods;
  std::vector<std::filesystem::path> files;  ///< that were read beyond the workcell's and scene's
};

/// Detects once for each image, locates each camera once, and then runs every method with every
/// subset of the cameras against the truth. Runs in the caller's task arena; the same result at any
/// number of threads. The result is meaningless if `stop` was cancelled.
/// @param workcell with its random objects placed: they are the truth.
/// @throws Error bad_input as `observe`, `true_objects`, `ReconstructionEvaluator` and
/// `camera_subsets` do, and if no camera could be located or no subset sees every object.
ReconstructionEvaluation evaluate_reconstruction(const BopScene& scene, const Workcell& workcell,
                                                 const ReconstructionEvaluationOptions& options,
                                                 const StopToken& stop);

}  // namespace vantage
