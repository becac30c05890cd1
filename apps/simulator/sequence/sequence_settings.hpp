#pragma once

#include <map>
#include <string>
#include <vector>

#include "simulator/sequence/random_sequence.hpp"

namespace vantage {

/// An object is carried to another place.
struct PlannedMove {
  std::string object;
  double from_s = 0, to_s = 0;
  Pose T_world_object;
  bool visibly = true;
  std::string place = {};  ///< in the file, for errors
};

/// An object stands there from a time on.
struct PlannedAddition {
  double at_s = 0;
  std::string name;
  TypePtr type;
  Pose T_world_object;
  std::string place = {};
};

struct PlannedRemoval {
  double at_s = 0;
  std::string object;
  std::string place = {};
};

/// What a workcell's file says of its sequence.
struct SequenceSettings {
  /// With the numbers of instants and random events; where the file plans events, there are no
  /// random ones unless it asks for them.
  RandomSequence random = {};
  std::map<std::string, double> delays_s = {};  ///< of cameras that are out of step, by name
  std::vector<PlannedMove> moved = {};          ///< ascending in time, as are the others
  std::vector<PlannedAddition> added = {};
  std::vector<PlannedRemoval> taken_away = {};

  bool has_planned_events() const {
    return !moved.empty() || !added.empty() || !taken_away.empty();
  }
};

/// The plan of these settings: planned events or random ones.
/// @param seed of what is random.
/// @throws Error bad_input, with the event's place, for objects that are not there at the time, and
/// times that overlap; "delays_s" for a camera that there is none; for random events beside planned
/// ones; and as `random_sequence` does.
SequencePlan plan_sequence(const SequenceScene& scene, const SequenceSettings& settings,
                           std::uint64_t seed);

}  // namespace vantage
