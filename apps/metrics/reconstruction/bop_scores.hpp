#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "metrics/reconstruction/reconstruction_evaluator.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage {

/// An image in which a reconstruction is compared with the ground truth.
struct ScoredImage {
  Intrinsics camera;
  Pose T_world_cam;
  std::shared_ptr<const DepthImage> depth;  ///< null: VSD is not measured, and nothing hides
};

/// BOP's errors of an estimate, relative to the true object that it was matched to
/// (`ReconstructionEvaluator::matches`). Those of `ObjectErrors` have symmetries taken out; of
/// these, MSSD alone knows of them.
struct EstimateErrors {
  std::size_t estimate = 0, truth = 0;
  double translation_m = 0, rotation_rad = 0, add_m = 0, add_s_m = 0, mssd_m = 0;
};

/// Of every estimate that was matched, in their order.
std::vector<EstimateErrors> estimate_errors(const ReconstructionEvaluator& evaluator,
                                            const Reconstruction& reconstruction);

/// What the BOP challenge (of 2019 and later) says of a reconstruction.
struct BopScores {
  std::size_t targets = 0;  ///< objects in images that are visible by a tenth or more
  double ar_mssd = 0;       ///< average recall over MSSD below 0.05, 0.1, … 0.5 diameters
  double ar_mspd = 0;       ///< over MSPD below 5, 10, … 50 pixels of an image 640 wide
  std::optional<double> ar_vsd = {};  ///< over ten misalignments and ten thresholds; with depth

  /// BOP's AR: the mean of the three; none without VSD.
  std::optional<double> average_recall() const {
    if (!ar_vsd) return {};
    return (*ar_vsd + ar_mssd + ar_mspd) / 3;
  }
};

/// Scores a reconstruction in every image, whichever of them it was made from. Estimates of objects
/// that are no target in an image are left out there, as BOP does. Runs in the caller's task arena;
/// the same bits at any number of threads. Nothing without a target.
std::optional<BopScores> bop_scores(const ReconstructionEvaluator& evaluator,
                                    const Reconstruction& reconstruction,
                                    std::span<const ScoredImage> images);

}  // namespace vantage
