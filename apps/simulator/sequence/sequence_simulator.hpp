#pragma once

#include <memory>
#include <vector>

#include "simulator/sequence/marker_sight.hpp"
#include "simulator/sequence/sequence_plan.hpp"
#include "vantage/reconstruction/observation.hpp"
#include "vantage/volume/stereo_sensor.hpp"

namespace vantage {

/// How features and depth are measured without pictures.
struct FeatureSensor {
  double sigma_px = 0.1;  ///< standard deviation of each coordinate of a marker's corners
  StereoSensor depth = {};
  int depth_width = 160;  ///< pixels; as high as the camera's image is; 0: no depth
};

/// What the cameras of a sequence see at one instant.
struct SimulatedInstant {
  double time_s = 0;
  SequenceMoment truth;           ///< at `time_s`
  std::vector<CameraView> views;  ///< of markers, as a detector would give them
  std::vector<DepthCamera> depth;
  std::vector<bool> seen;  ///< of the plan's objects: some camera's detector found a marker of it
};

/// Plays a plan before cameras. Markers are found by rays and by the detector's recall, and not in
/// pictures: thousands of instants take seconds. Immutable; thread-safe.
///
/// Random numbers hash (seed, instant, camera, object, feature): the same call gives the same bits.
class SequenceSimulator {
 public:
  /// @param fixed what never moves: static structures, the board's plate.
  /// @throws Error bad_input as `SequencePlan::check` and `StereoSensor::check` do, and for a
  /// `sigma_px` that is not positive.
  SequenceSimulator(SequencePlan plan, std::vector<KnownObject> fixed,
                    std::vector<SequenceCamera> cameras, const FeatureSensor& sensor,
                    std::uint64_t seed);

  const SequencePlan& plan() const noexcept { return plan_; }
  const std::vector<SequenceCamera>& cameras() const noexcept { return cameras_; }
  const std::vector<KnownObject>& fixed() const noexcept { return fixed_; }

  SimulatedInstant at(int instant) const;

  /// Whether at that instant some camera would more likely than not find a marker of an object, if
  /// it stood there.
  bool would_be_seen(int instant, const ObjectType& type, const Pose& T_world_object) const;

 private:
  SequencePlan plan_;
  std::vector<KnownObject> fixed_;
  std::vector<SequenceCamera> cameras_;
  FeatureSensor sensor_;
  std::uint64_t seed_;
};

/// Everything that stands there at a moment, under a BVH.
std::shared_ptr<const Scene> scene_of(const SequencePlan& plan, const SequenceMoment& moment,
                                      std::span<const KnownObject> fixed);

/// Whether one of these cameras would more likely than not find a marker of an object there.
bool likely_seen(const ObjectType& type, const Pose& T_world_object,
                 std::span<const SequenceCamera> cameras, const Scene& scene);

}  // namespace vantage
