#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "metrics/bop/error_model.hpp"

namespace vantage {

/// A vertex of one object that lies, in truth, where a vertex of another does. Objects' frames.
struct TouchingCorners {
  std::size_t object_a = 0, object_b = 0;  ///< a < b
  Eigen::Vector3d corner_a, corner_b;
};

/// An object and where it stands.
struct PlacedModel {
  const ErrorModel* model = nullptr;
  Pose T_world_object;
};

/// Every such pair of corners, each place of a mesh once however many vertices it has there.
std::vector<TouchingCorners> touching_corners(std::span<const PlacedModel> objects,
                                              double tolerance_m = 1e-4);

/// The thesis' self-consistency error (chapter 8), in mm²: the sum over all pairs of the squared
/// distance of their corners.
/// @param T_world_object of every object, as it was reconstructed. For an object with symmetries
/// the pose among equals that is nearest to the truth; otherwise its corners are others.
double self_consistency_mm2(std::span<const TouchingCorners> pairs,
                            std::span<const Pose> T_world_object);

}  // namespace vantage
