#pragma once

#include <cstdint>
#include <optional>

#include "vantage/raycore/export.hpp"
#include "vantage/volume/stereo_sensor.hpp"

namespace vantage {

/// Which number the voxel method scores a view by.
enum class ViewValue {
  expected,  ///< the volume that the movable camera is expected to turn from shadow to free or
             ///< occupied
  bound,  ///< the shadow in its line of sight, if it measures everything and nothing unknown is in
          ///< the way: the thesis' number, and an upper bound of the other
};

/// What the expected gain of a view is computed from (`ExpectedScorer`).
struct ExpectedGainOptions {
  /// Of the movable camera. `StereoSensor::ideal()` measures whatever it has in sight.
  StereoSensor sensor = {};

  /// Assumed depth of unknown objects whose front was measured, as a multiple of their visible
  /// width (the smaller one): a shadow voxel at s behind the front of a thing w wide is inside of
  /// it with probability exp(-(s / (unknown_depth w))²). The default is from simulated cells
  /// (`vantage evaluate expected-gain`). 0: there are no unknown objects.
  double unknown_depth = 0.8;

  /// Height of the floor, world frame, of which the given images tell how often it gives a reading;
  /// none: rays that meet nothing known end nowhere. `plan` takes `ViewConstraints::floor_z_m`.
  std::optional<double> floor_z_m = 0.0;

  /// @throws Error bad_input as `StereoSensor::check` does, and unless the depth is finite and not
  /// negative.
  VANTAGE_API void check() const;
  bool operator==(const ExpectedGainOptions&) const = default;
};

/// What a view is expected to gain, in volume.
struct GainEstimate {
  double expected_m3 = 0;
  double low_m3 = 0, high_m3 = 0;  ///< nine of ten views gain something in between
  bool operator==(const GainEstimate&) const = default;
};

}  // namespace vantage
