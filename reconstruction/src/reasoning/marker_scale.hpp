#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::reconstruction::detail {

/// A size in which objects that single cameras see are one object: one of which all sizes are
/// `factor` times the stated ones stands `factor` times as far from each camera.
struct FittingSize {
  double factor = 1;
  Eigen::Vector3d place_m;  ///< where the cameras then have it; world frame
  std::string text;         ///< a clause to append to a reason
};

/// The size that brings two of these objects together, seen by one camera each. Nothing if no size
/// does, or the stated one.
std::optional<FittingSize> fitting_size(std::span<const CameraView> views,
                                        std::span<const ReconstructedObject* const> objects,
                                        const TypePtr& type);

/// Whether an object, seen by one camera, comes to that place in that size, too.
bool comes_there(std::span<const CameraView> views, const ReconstructedObject& object,
                 const FittingSize& size);

}  // namespace vantage::reconstruction::detail
