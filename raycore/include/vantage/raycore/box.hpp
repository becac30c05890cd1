#pragma once

#include <Eigen/Core>
#include <string_view>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// An axis-aligned box with a volume, metres. Immutable value type.
class VANTAGE_API Box {
 public:
  /// @throws Error bad_input unless both corners are finite and min < max along every axis.
  Box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, std::string_view where = "box");

  const Eigen::Vector3d& min() const noexcept { return min_; }
  const Eigen::Vector3d& max() const noexcept { return max_; }
  Eigen::Vector3d size() const { return max_ - min_; }
  Eigen::Vector3d centre() const { return 0.5 * (min_ + max_); }
  double volume_m3() const { return size().prod(); }
  bool contains(const Eigen::Vector3d& point) const;

 private:
  Eigen::Vector3d min_;
  Eigen::Vector3d max_;
};

}  // namespace vantage
