#pragma once

#include <memory>
#include <span>
#include <vector>

#include "grid/block_set.hpp"
#include "objects/mesh_instance.hpp"
#include "objects/silhouette_map.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage::volume::detail {

/// What hides voxels from cameras, in the grid's frame. Immutable; may be asked from many threads.
class Occluders {
 public:
  virtual ~Occluders() = default;

  virtual bool empty() const = 0;

  /// Which of `voxels` (one for each of `centres`) are hidden from a camera at `camera_centre`: 1
  /// or 0 for each.
  virtual void hidden(std::span<const Eigen::Vector3i> voxels, PointsView centres,
                      const Eigen::Vector3d& camera_centre,
                      std::span<std::uint8_t> result) const = 0;

  /// Adds all outline edges as a camera sees them.
  virtual void add_contours(const PinholeCamera& camera, ContourMap& map) const = 0;
};

/// Which meshes are instances of one geometry in `mesh_occluders`: their triangles are met in their
/// own frame, so that rays along their edges may round in another way.
std::vector<bool> share_geometry(const std::vector<PlacedMesh>& meshes);

/// `OccluderMode::mesh`: rays meet the exact triangles.
std::unique_ptr<const Occluders> mesh_occluders(std::vector<PlacedMesh> meshes);

/// `OccluderMode::voxels`: a line of sight in double precision meets every closed voxel of a set
/// that it touches, within 1e-9 of a voxel. `solid` must outlive the result.
std::unique_ptr<const Occluders> voxel_occluders(const BlockSet& solid, double voxel_size_m);

}  // namespace vantage::volume::detail
