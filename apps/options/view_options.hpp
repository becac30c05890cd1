#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "options/field.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage {

/// How views are scored, refined and chosen: what a workcell's `plan` and the command line say of
/// it.
struct ViewOptions {
  std::string method{VoxelMethod::kName};
  ViewValue value = ViewValue::expected;
  bool ideal_sensor = false;  ///< the movable camera measures everything in its line of sight
  StereoSensor sensor;        ///< else this is how it measures
  double unknown_depth = ExpectedGainOptions().unknown_depth;
  MeshMethod mesh;                        ///< but for its weight and power
  std::optional<double> depth_power;      ///< not given: the default
  std::optional<MeshWeight> mesh_weight;  ///< not given: by depth if its power is
  ServoOptions servo;
  PolishOptions polish;
  int ranked = SearchOptions().ranked;
  double travel_weight_per_m = 0;
  std::optional<Eigen::Vector3d> from_m;  ///< none: travel costs nothing
  ViewSequenceOptions views;

  /// The mesh method as it is asked for, whichever method is chosen.
  MeshMethod mesh_method() const;

  /// Puts all of it into a request.
  /// @throws Error bad_input for a travel weight without a start position.
  void apply(PlanRequest& request) const;

 private:
  Method chosen() const;
};

// The descriptions point into what they describe.

FieldGroup fields_of(ViewOptions& options);
/// How the expected gain is computed; the sensor itself is described with the movable camera.
FieldGroup expected_gain_fields(ViewOptions& options);
FieldGroup fields_of(ServoOptions& servo);
FieldGroup fields_of(PolishOptions& polish);
FieldGroup fields_of(MeshMethod& mesh);
FieldGroup fields_of(ViewSequenceOptions& views);

}  // namespace vantage
