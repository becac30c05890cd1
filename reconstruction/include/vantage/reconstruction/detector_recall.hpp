#pragma once

#include "vantage/raycore/export.hpp"

namespace vantage {

/// How likely vantage's marker detector is to find a marker that is in full view: by the length of
/// its side, as a camera that faced it from there would see it, in pixels, and by the angle between
/// its normal and the line to the camera. Linear between measured values.
///
/// Measured on 4X4 markers in pictures of the simulator's default sensor and light; the test cases
/// of tests/simulator/sequence/test_detector_recall.cpp say how, and one of them (skipped unless
/// asked for) prints the table anew.
VANTAGE_API double detector_recall(double side_px, double angle_rad);

}  // namespace vantage
