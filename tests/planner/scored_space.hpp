#pragma once

#include <memory>

#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"

namespace vantage::test {

/// The shell that the mesh method's unseen space is in; an empty mesh if there is none.
inline TriangleMesh shell_of(const SeenWorld& world) {
  return world.opened ? shell_around_shadow(*world.opened) : TriangleMesh();
}

/// The space whose unseen part the mesh method scores.
inline std::unique_ptr<const UnobservedSpace> scored_space(const SeenWorld& world) {
  const TriangleMesh shell = shell_of(world);
  return std::make_unique<const UnobservedSpace>(world.lattices, world.work_area,
                                                 world.opened ? &shell : nullptr);
}

}  // namespace vantage::test
