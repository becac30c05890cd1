#pragma once

#include <memory>

#include "vantage/planner/mesh_scorer.hpp"
#include "vantage/raycore/seen_space.hpp"
#include "vantage/volume/shadow_filter.hpp"

namespace vantage::test {

/// The space whose unseen part the mesh method scores.
inline std::unique_ptr<const SeenSpace> scored_space(const SeenWorld& world) {
  TriangleMesh shell;
  if (world.opened) shell = shell_around_shadow(*world.opened);
  return std::make_unique<const SeenSpace>(world.lattices, world.work_area,
                                           world.opened ? &shell : nullptr);
}

}  // namespace vantage::test
