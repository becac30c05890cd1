#pragma once

#include <Eigen/Core>
#include <memory>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// What every method, the servo and the constraints look at, made once per plan: what hides, and
/// the shadow. Immutable; thread-safe; cheap to copy.
class VANTAGE_API PlanningScene {
 public:
  /// @param grid a classification of `world`; never null.
  PlanningScene(const WorldModel& world, std::shared_ptr<const StateGrid> grid, OccluderMode mode);

  const StateGrid& grid() const noexcept { return *grid_; }

  /// Everything occupied: the objects of `occluder_scene`.
  const Scene& occluders() const noexcept { return *occluders_; }

  /// The same objects under the same ids, then the open faces of the shadow, `shadow_object()`, and
  /// the covered ones, `covered_object()` (`shadow_surface`). In front of a free voxel,
  /// a ray's first hit says whether it meets shadow or something occupied.
  const Scene& surfaces() const noexcept { return *surfaces_; }
  ObjectId shadow_object() const noexcept { return ObjectId(occluders_->object_count()); }
  ObjectId covered_object() const noexcept { return shadow_object() + 1; }

  /// The open ones: merged rectangles, two triangles each, outwards.
  const TriangleMesh& shadow_faces() const noexcept { return *shadow_faces_; }

  /// `grid().centres(shadow)`.
  PointsView shadow_centres() const noexcept { return *shadow_centres_; }

  /// Their mean, which the servo measures distances to; the grid's middle if there is no shadow.
  Eigen::Vector3d middle_of_shadow() const;

 private:
  std::shared_ptr<const StateGrid> grid_;
  std::shared_ptr<const Scene> occluders_, surfaces_;
  std::shared_ptr<const TriangleMesh> shadow_faces_;
  std::shared_ptr<const Points> shadow_centres_;
};

}  // namespace vantage
