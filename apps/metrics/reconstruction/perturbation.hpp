#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/reconstruction/observation.hpp"

namespace vantage {

/// Simulates a worse detector. The same seed and trial give the same perturbation, independent of
/// the order of calls.
struct Perturbation {
  double noise_px = 0;   ///< standard deviation added to each coordinate of points
  double drop = 0;       ///< share of the observations that are lost
  double wrong_ids = 0;  ///< share that is read as another key
  std::uint64_t seed = 1;

  /// @throws Error bad_input, the member as the place, for noise that is negative or not finite,
  /// and for shares that are not from 0 to 1.
  void check() const;
};

/// The views with perturbed observations; their `sigma_px` includes the noise.
/// @param keys that a detector may read by mistake. Only keys of the same type are taken, and an
/// observation without another key of its type keeps its own.
std::vector<CameraView> disturbed(std::span<const CameraView> views,
                                  const Perturbation& perturbation, std::uint64_t trial,
                                  std::span<const FeatureKey> keys);

}  // namespace vantage
