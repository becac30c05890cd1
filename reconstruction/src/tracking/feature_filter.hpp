#pragma once

#include <map>
#include <span>
#include <vector>

#include "tracking/track.hpp"

namespace vantage::reconstruction::detail {

/// The thesis' first way to filter over time (section 6.4.1): features of older snapshots count
/// together with the current ones, the less the older they are. An object's old features are
/// forgotten when it moves.
class FeatureFilter {
 public:
  /// @param decay_s the weight of a feature falls by a factor of e in this time.
  explicit FeatureFilter(double decay_s) : decay_s_(decay_s) {}

  /// Takes in what this snapshot saw of an object.
  /// @param place where the object stands: features that are older than `since_s` are forgotten.
  /// @returns its pose by old and new features together.
  PoseMeasurement update(TrackId id, const ReconstructedObject& object, const Place& place,
                         double time_s, std::span<const CameraView> views);

 private:
  struct Remembered {
    double time_s;
    std::size_t view, feature;
    Observation observation;
  };

  double decay_s_;
  std::map<TrackId, std::vector<Remembered>> remembered_;
};

}  // namespace vantage::reconstruction::detail
