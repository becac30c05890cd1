#pragma once

#include "reference/moller_trumbore.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage::test {

/// What the plain algorithm says of a voxel. `close_call`: some decision on the way was within
/// `kCloseCall` of falling the other way, so that float and double may disagree.
struct PlainState {
  VoxelState state = VoxelState::shadow;
  bool measured = false;
  std::optional<ShadowCause> cause = {};  ///< of shadow
  bool close_call = false;
};

/// The slow, obvious twin of `classify` in `mesh` mode: voxel by voxel, camera by camera, in double
/// precision, every ray against every triangle; a point is inside a mesh if the mesh surrounds it
/// (the sum of the triangles' solid angles is 4π). Knows closed meshes only, and does no
/// anti-aliasing.
class PlainClassifier {
 public:
  /// World and geometry must outlive the classifier.
  PlainClassifier(const WorldModel& world, const GridGeometry& geometry,
                  const VolumeOptions& options = {});

  PlainState classify(const Eigen::Vector3i& voxel) const;

  /// Whether a depth image sees through a voxel, whatever is known to be there.
  bool sees_through(const DepthCamera& observer, const Eigen::Vector3i& voxel,
                    bool& close_call) const;

  /// Whether a camera sees a point past all known objects; what it measured is left aside.
  Verdict hidden(const PinholeCamera& camera, const Eigen::Vector3d& point) const;

 private:
  bool inside_known(const Eigen::Vector3d& point, bool& close_call) const;
  enum class Says { outside, hidden, unmeasured, free, surface };
  Says ask(const DepthCamera& observer, const Eigen::Vector3i& voxel, bool& close_call) const;
  Says compare_with_depth(const DepthCamera& observer, const Eigen::Vector3i& voxel,
                          bool& close_call) const;
  bool holds_measured_point(const DepthCamera& observer, const Eigen::Vector3i& voxel,
                            bool& close_call) const;

  const WorldModel& world_;
  const GridGeometry& geometry_;
  VolumeOptions options_;
  ReferenceScene known_;
  std::vector<TriangleMesh> solids_;
};

/// Whether a point is in a camera's image and depth range.
bool plain_in_view(const PinholeCamera& camera, const Eigen::Vector3d& point, bool& close_call);

}  // namespace vantage::test
