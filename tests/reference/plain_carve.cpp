#include "reference/plain_carve.hpp"

#include <algorithm>

namespace vantage::test {
namespace {

/// Metres; a hundred times what double rounding may move a point of a work area of a few metres.
constexpr double kHair = 1e-9;

template <class Says>
PlainSeen ask(std::span<const VisibilityMesh> lattices, const Eigen::Vector3d& p,
              const Says& says) {
  const auto any = [&](const Eigen::Vector3d& point) {
    return std::any_of(lattices.begin(), lattices.end(),
                       [&](const VisibilityMesh& lattice) { return says(lattice, point); });
  };
  PlainSeen result{any(p), false};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-kHair, kHair}) {
      if (any(p + step * Eigen::Vector3d::Unit(axis)) != result.seen) result.close_call = true;
    }
  }
  return result;
}

}  // namespace

PlainSeen plain_seen(std::span<const VisibilityMesh> lattices, const Eigen::Vector3d& p_world) {
  return ask(lattices, p_world, [](const VisibilityMesh& lattice, const Eigen::Vector3d& p) {
    return lattice.sees(p);
  });
}

PlainSeen plain_covered(std::span<const VisibilityMesh> lattices, const Eigen::Vector3d& p_world) {
  return ask(lattices, p_world, [](const VisibilityMesh& lattice, const Eigen::Vector3d& p) {
    const auto at = lattice.camera.project(p);
    return at && at->u >= double(lattice.columns.front()) &&
           at->u <= double(lattice.columns.back()) && at->v >= double(lattice.rows.front()) &&
           at->v <= double(lattice.rows.back());
  });
}

}  // namespace vantage::test
