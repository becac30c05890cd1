#pragma once

#include <Eigen/Core>
#include <string>

namespace vantage::detail {

/// @throws Error bad_input, `name` as the place, unless the length is positive and finite.
void check_length(double length_m, const std::string& name);

/// The same for each edge of a box.
void check_size(const Eigen::Vector3d& size_m);

}  // namespace vantage::detail
