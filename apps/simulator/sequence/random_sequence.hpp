#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulator/sequence/marker_sight.hpp"
#include "simulator/sequence/sequence_plan.hpp"
#include "vantage/raycore/box.hpp"

namespace vantage {

/// What random sequences take place in.
struct SequenceScene {
  /// Objects at the start, at rest; their `stays` are one without an end.
  std::vector<SequenceObject> objects;
  Box floor;  ///< objects stand on its lower face
  std::vector<KnownObject>
      obstacles;                   ///< of what rises above the floor, what objects must not touch
  std::vector<KnownObject> fixed;  ///< everything that never moves, as cameras see it
  std::vector<SequenceCamera> cameras;
};

/// What happens in a random sequence.
struct RandomSequence {
  int instants = 200;
  double period_s = 0.1;
  int moves = 10, added = 0, taken_away = 0;
  int carry_instants = 5;      ///< that a move takes
  double visible_share = 0.5;  ///< of moves through the air; the others in a closed hand
  bool arm = true;             ///< carries, and passes in between
  std::uint64_t seed = 0;

  /// @throws Error bad_input, the member as the place, for numbers that do not go together.
  void check() const;
};

/// Events follow each other evenly, one at a time. Objects go to places at rest where they touch
/// nothing, at least a diameter from where they were, and where a camera more likely than not sees
/// a marker of them (the arm aside). What is added is of the types of `scene.objects`, in turns.
/// The same seed, the same plan.
/// @throws Error bad_input as `RandomSequence::check` and `place_at_rest` do, and where no such
/// place is found.
SequencePlan random_sequence(const SequenceScene& scene, const RandomSequence& options);

}  // namespace vantage
