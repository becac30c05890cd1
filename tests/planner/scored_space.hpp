#pragma once

#include <memory>

#include "vantage/planner/mesh_scorer.hpp"
#include "vantage/raycore/unobserved_space.hpp"
#include "vantage/volume/shadow_filter.hpp"

namespace vantage::test {

/// The shell that the mesh method's unseen space is in; an empty mesh if there is none.
inline TriangleMesh shell_of(const SeenWorld& world) {
  return world.opened ? shell_around_shadow(*world.opened) : TriangleMesh();
}

/// The space whose unseen part the mesh method scores.
inline std::unique_ptr<const SeenSpace> scored_space(const SeenWorld& world) {
  const TriangleMesh shell = shell_of(world);
  return std::make_unique<const SeenSpace>(world.lattices, world.work_area,
                                           world.opened ? &shell : nullptr);
}

}  // namespace vantage::test
