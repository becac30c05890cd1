#pragma once

#include <limits>

#include "metrics/bop/error_model.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage {

// Errors of an object's estimated pose, as the BOP toolkit defines them (pose_error.py; Hodaň et
// al., "BOP: Benchmark for 6D Object Pose Estimation", ECCV 2018, and its challenge of 2019). Both
// poses are T_ref_object in any one frame, unless a camera's is asked for. Metres, radians, pixels.
// All are thread-safe.

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// TE: the distance of the origins.
double translation_error_m(const Pose& estimate, const Pose& truth);

/// RE: the angle of the rotation from one to the other, 0 to π.
double rotation_error_rad(const Pose& estimate, const Pose& truth);

/// ADD: the mean distance of the vertices.
double add_m(const ErrorModel& model, const Pose& estimate, const Pose& truth);

/// ADD-S (ADI): the mean distance from the true vertices to the nearest estimated ones.
double add_s_m(const ErrorModel& model, const Pose& estimate, const Pose& truth);

/// The true pose after that symmetry of the object with which it fits the estimate best, in MSSD's
/// sense; the first of equals.
struct SymmetricTruth {
  Pose T_ref_object;
  double mssd_m = 0;
};
SymmetricTruth nearest_symmetric(const ErrorModel& model, const Pose& estimate, const Pose& truth);

/// MSSD: the largest distance of a vertex, the least over the object's symmetries.
double mssd_m(const ErrorModel& model, const Pose& estimate, const Pose& truth);

/// MSPD: the same on the image, in pixels; poses are T_cam_object. Infinite if a vertex is not
/// before the camera.
double mspd_px(const ErrorModel& model, const Pose& estimate, const Pose& truth,
               const Intrinsics& camera);

}  // namespace vantage
