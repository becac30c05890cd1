#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "hypothesis/expected_markers.hpp"
#include "reasoning/evidence_depth.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/object_type.hpp"

// Private: what the cameras say of objects that are not seen: are they hidden, or gone?
namespace vantage::reconstruction::detail {

/// What an object that stands at a pose should look like to the cameras of a snapshot. Refers to
/// all that it is made of; thread-safe once made.
class Presence {
 public:
  /// @param scene what hides objects; they may be in it themselves.
  Presence(std::span<const CameraView> views, std::span<const DepthCamera> depth,
           const Scene& scene);

  /// How likely a view's detector finds a feature of an object at this pose. 0 for a view that is
  /// not located, and where something known or measured is in the way.
  double found_probability(std::size_t view, const ObjectFeature& feature,
                           const Pose& T_world_object) const;

  /// For each view, how likely it misses all of the object's features that are hardly ever missed,
  /// if nothing unknown hides them: 1 if it may see none.
  std::vector<double> missed_probability(const ObjectType& type, const Pose& T_world_object) const;

  /// All images together.
  DepthAtObject depth_at(const std::vector<SurfacePoint>& surface,
                         const Pose& T_world_object) const;

  bool has_depth_beside(std::size_t view) const { return !depth_beside_[view].empty(); }

 private:
  bool is_in_sight(std::size_t view, const std::vector<Eigen::Vector3d>& points,
                   const Pose& T_world_object) const;
  bool is_sure_to_see(std::size_t view, const ObjectFeature& feature,
                      const Pose& T_world_object) const;
  bool is_behind_something(std::size_t view, const std::vector<Eigen::Vector3d>& points,
                           const Pose& T_world_object) const;
  bool is_measured_before(std::size_t view, const Eigen::Vector3d& p_world) const;

  std::span<const CameraView> views_;
  std::span<const DepthCamera> depth_;
  const Scene& scene_;
  std::vector<std::unique_ptr<ExpectedMarkers>> markers_;      // null: not located
  std::vector<std::vector<const DepthCamera*>> depth_beside_;  // of each view
};

}  // namespace vantage::reconstruction::detail
