#include "mesh/solid_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage::detail {

void check_length(double length_m, const std::string& name) {
  if (std::isfinite(length_m) && length_m > 0) return;
  throw bad_input(name, fmt::format("is {} m; expected a finite length above 0", length_m));
}

void check_size(const Eigen::Vector3d& size_m) {
  if (size_m.allFinite() && size_m.minCoeff() > 0) return;
  throw bad_input("size_m", fmt::format("is ({}, {}, {}) m; expected three finite lengths above 0",
                                        size_m.x(), size_m.y(), size_m.z()));
}

}  // namespace vantage::detail
