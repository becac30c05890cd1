#pragma once

#include <span>
#include <vector>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "workcell/workcell_objects.hpp"

namespace vantage {

/// The objects that cameras could recognise: of some feature's points (a marker's corners) all are
/// in one camera's view, with nothing in front of them. What has no such feature is left out, but
/// an object without a type is kept: it does not have to be recognised.
/// @param truth everything that stands there.
std::vector<PlacedObject> recognisable_objects(std::span<const PlacedObject> objects,
                                               std::span<const PinholeCamera> cameras,
                                               const Scene& truth);

}  // namespace vantage
