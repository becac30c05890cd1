#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "hypothesis/expected_markers.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/object_type.hpp"

// Private: what the cameras say of objects that are not seen: are they hidden, or gone?
namespace vantage::reconstruction::detail {

/// A point of an object's surface.
struct SurfacePoint {
  Eigen::Vector3d p_object, normal;
};

/// Points spread over a mesh by area, always the same ones.
std::vector<SurfacePoint> surface_points(const TriangleMesh& mesh);

/// What the depth images show where an object would be.
struct DepthAtObject {
  int through = 0;  ///< of its surface's points: what is seen there lies behind
  int at = 0;       ///< a surface is measured there
  int hidden = 0;   ///< something nearer is measured

  /// Whether light came through where the object would be.
  bool refutes() const { return through >= 6 && through * 10 >= (through + at) * 7; }
  /// Whether something is there, of this shape as far as can be seen.
  bool supports() const { return at >= 6 && at * 10 >= (through + at) * 7; }
};

/// What an object that stands at a pose should look like to the cameras of a snapshot. Refers to
/// all that it is made of; thread-safe once made.
class Presence {
 public:
  /// @param scene what hides objects; they may be in it themselves.
  Presence(std::span<const CameraView> views, std::span<const DepthCamera> depth,
           const Scene& scene);

  /// For each view, how many of the object's features it should see: 0 for one that is not located,
  /// or in whose way something known or measured is.
  std::vector<int> expected_features(const ObjectType& type, const Pose& T_world_object) const;

  DepthAtObject depth_at(const std::vector<SurfacePoint>& surface,
                         const Pose& T_world_object) const;

 private:
  bool sees(std::size_t view, const ObjectFeature& feature, const Pose& T_world_object) const;
  bool is_measured_before(std::size_t view, const Eigen::Vector3d& p_world) const;

  std::span<const CameraView> views_;
  std::span<const DepthCamera> depth_;
  const Scene& scene_;
  std::vector<std::unique_ptr<ExpectedMarkers>> markers_;      // null: not located
  std::vector<std::vector<const DepthCamera*>> depth_beside_;  // of each view
};

}  // namespace vantage::reconstruction::detail
