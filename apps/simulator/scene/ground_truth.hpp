#pragma once

#include <memory>
#include <span>

#include "simulator/scene/simulated_scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// What no real camera can tell: which volume of the simulated cell is truly occupied, seen and
/// hidden, whatever a knowledge base and a depth sensor may make of it. Immutable; thread-safe.
class GroundTruth {
 public:
  /// Classifies the true scene as the given cameras see it: exact meshes of everything that stands
  /// there, no depth noise, no anti-aliasing.
  /// @throws Error as `classify` does.
  GroundTruth(const SimulatedScene& scene, std::span<const PinholeCamera> cameras,
              const GridGeometry& geometry);

  /// `occupied`: the centre is inside a body. `free`: some camera sees it. `shadow`: neither; the
  /// volume that is truly hidden (or in no camera's view).
  const StateGrid& grid() const noexcept { return *grid_; }
  const std::shared_ptr<const StateGrid>& shared_grid() const noexcept { return grid_; }

  /// Everything that stands there, as if all of it were known, and the cameras without depth.
  /// `grid()` is a classification of it.
  const WorldModel& world() const noexcept { return world_; }

  /// The true gain: how much of the hidden volume a new view really sees.
  double gain_m3(const PinholeCamera& view) const { return seen_m3(grid(), view); }

  /// How much of a believed shadow a new view really sees: inside the image and the depth range,
  /// nothing true in between. To be compared with what a planner predicted for the view.
  /// @param believed any grid of the same cell, at any resolution.
  double seen_m3(const StateGrid& believed, const PinholeCamera& view) const;

 private:
  WorldModel world_;
  std::shared_ptr<const StateGrid> grid_;
  std::shared_ptr<const Scene> rays_;
};

}  // namespace vantage
