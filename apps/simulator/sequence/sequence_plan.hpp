#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "simulator/sequence/arm.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {

/// An object stands at a place from one time to another.
struct Stay {
  double from_s = 0, to_s = std::numeric_limits<double>::infinity();
  Pose T_world_object = {};
  /// On the way to the next stay: through the air, or in a closed hand, where nothing sees it.
  bool carried_visibly = true;
};

/// An object, over all of a sequence. Before its first stay and after its last it is not there.
struct SequenceObject {
  std::uint64_t id = 0;  ///< from 1; unique
  std::string name;      ///< unique
  TypePtr type;
  std::vector<Stay> stays;  ///< ascending in time, without overlap; one at least
};

/// An arm that passes and carries.
struct SequenceArm {
  Arm arm;
  ArmPath path;
};

/// Everything that happens while a sequence is recorded. Instant i is at i × `period_s`.
struct SequencePlan {
  int instants = 1;
  double period_s = 0.1;
  std::vector<SequenceObject> objects = {};
  std::optional<SequenceArm> arm = {};
  std::vector<double> camera_delay_s = {};  ///< of each camera's pictures; empty: in step

  double time_s(int instant) const { return instant * period_s; }
  double delay_s(std::size_t camera) const {
    return camera < camera_delay_s.size() ? camera_delay_s[camera] : 0;
  }
  /// @throws Error bad_input, the member or the object's name as the place, for what is not as
  /// stated with it, and for times that are not finite.
  void check() const;
};

/// An object at one time.
struct ObjectAtTime {
  std::size_t object = 0;  ///< index in the plan
  Pose T_world_object = {};
  bool carried = false;
};

/// What stands there at one time beside what never moves.
struct SequenceMoment {
  std::vector<ObjectAtTime> objects;  ///< ascending by index
  std::vector<ArmPart> arm;
};

SequenceMoment moment_at(const SequencePlan& plan, double time_s);

/// The way of a carried object: up, over, down. `share` of the time, 0 to 1.
Pose carried_pose(const Pose& from, const Pose& to, double share);

/// So far above both places an object is carried.
inline constexpr double kLiftM = 0.15;
/// The shares of the time at which it is up, and begins to go down.
inline constexpr double kLifted = 0.25, kLowering = 0.75;

}  // namespace vantage
