#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "vantage/raycore/pose.hpp"

namespace vantage::reconstruction::detail {

/// The rigid motion that brings `from` closest to `to` in the least squares sense: with centroids
/// c_S, c_F and H = Σ (x_S - c_S)(x_F - c_F)ᵀ = U S Vᵀ the rotation is V diag(1, 1, det V Uᵀ) Uᵀ
/// (Kabsch, 1976; thesis, section 6.1, which prints U Vᵀ).
/// Nothing for fewer than three points, and for collinear ones.
std::optional<Pose> kabsch(std::span<const Eigen::Vector3d> from,
                           std::span<const Eigen::Vector3d> to);

}  // namespace vantage::reconstruction::detail
