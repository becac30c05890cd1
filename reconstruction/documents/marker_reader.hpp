#pragma once

#include <Eigen/Core>
#include <optional>

#include "documents/document_value.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage {

/// Reads one of a type's `features`.
/// @param box_size_m  of the object, if it is a box around its origin: only then it has faces.
/// @throws Error bad_input for a dictionary or an id that OpenCV does not have, and a `face` of
/// something that is no box.
Marker read_marker(const Value& feature, const std::optional<Eigen::Vector3d>& box_size_m);

/// @throws Error bad_input with the place of the key for a dictionary that OpenCV does not have or
/// an id outside of it.
void check_marker(const Value& dictionary, const Value& id);

}  // namespace vantage
