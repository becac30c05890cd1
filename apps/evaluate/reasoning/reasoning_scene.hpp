#pragma once

#include <span>
#include <vector>

#include "evaluate/tracking/sequence_truth.hpp"
#include "metrics/reconstruction/perturbation.hpp"
#include "vantage/reconstruction/check_scene.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// A random scene of a workcell, as its cameras see it.
struct ReasoningScene {
  std::vector<CameraView> views;  ///< perturbed
  SceneKnowledge knowledge;
  std::vector<TruthAt> truth;  ///< judged: some camera's detector found a marker of it
};

/// @param workcell its `random_objects` are placed with `seed`.
/// @param keys that a detector may read by mistake.
/// @throws Error bad_input as `place_random_objects` and `sequence_scene` do.
ReasoningScene reasoning_scene(const Workcell& workcell, const FeatureSensor& sensor,
                               Perturbation perturbation, std::span<const FeatureKey> keys,
                               const TypeModels& types, std::uint64_t seed);

}  // namespace vantage
