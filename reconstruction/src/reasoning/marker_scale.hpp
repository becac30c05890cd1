#pragma once

#include <span>
#include <string>
#include <vector>

#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::reconstruction::detail {

/// The size in which the objects of a type, each seen by one camera, would be at one place: an
/// object of which all sizes are `s` times the stated ones stands `s` times as far from the camera.
/// @returns a clause to append to a reason; empty if no size brings them together.
std::string fitting_size(std::span<const CameraView> views,
                         std::span<const ReconstructedObject* const> objects, const TypePtr& type);

}  // namespace vantage::reconstruction::detail
