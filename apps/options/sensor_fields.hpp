#pragma once

#include "options/field.hpp"
#include "simulator/color/color_sensor.hpp"
#include "simulator/depth/depth_sensor.hpp"

namespace vantage {

// The simulated cameras. The descriptions point into what they describe; the lens' distortion is
// not among the fields.

FieldGroup fields_of(ColorSensor& color);
FieldGroup fields_of(StereoSensor& depth);

/// What one count of a recorded depth image is.
Field depth_scale_field(double& depth_scale_mm);

}  // namespace vantage
