#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulator/placement/random_stack.hpp"
#include "simulator/sequence/sequence_simulator.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/reconstruction/support.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

struct StabilityBenchmarkOptions {
  int stacks = 200;  ///< every other one without fault, then removed and shifted in turns
  int scenes = 20;   ///< of the workcell's random objects, that all stand on the floor
  std::uint64_t seed = 1;
  FeatureSensor sensor = {};
  SupportOptions support = {};
};

/// How many verdicts were right, of stacks with one fault.
struct StackVerdicts {
  std::size_t judged = 0, right = 0;
  std::size_t incomplete = 0;               ///< some object of them was not found: not judged
  std::array<std::size_t, 6> objects = {};  ///< of stacks that were judged, by SupportVerdict
};

/// Errors of all objects at rest that were found, as reconstructed and after `pull_to_contact`.
struct RestingErrors {
  std::size_t objects = 0, pulled = 0, flagged = 0;  ///< flagged: said not to stand
  struct Sums {
    double translation_m = 0, rotation_rad = 0, nees = 0;
  };
  Sums before, after;

  void add(const RestingErrors& other);
};

struct StabilityEvaluation {
  std::array<StackVerdicts, 3> stacks = {};  ///< by StackFault
  RestingErrors in_stacks, in_scenes;
  bool partial = false;

  StackVerdicts all_stacks() const;
};

/// Judges random stacks, half of them broken, and pulls objects at rest to what they stand on, as
/// reconstructed from simulated features. The verdict on a stack is right if all of one without
/// fault stands, and if in a broken one something from the fault upwards does not and nothing below
/// it is blamed. Runs in the caller's task arena; the same result at any number of threads.
/// @param workcell with cameras and types to recognise; its `random_objects` are placed anew for
/// every scene.
/// @throws Error bad_input as `sequence_scene`, `StackMaker` and `place_random_objects` do.
StabilityEvaluation evaluate_stability(const Workcell& workcell,
                                       const StabilityBenchmarkOptions& options,
                                       const StopToken& stop = {});

}  // namespace vantage
