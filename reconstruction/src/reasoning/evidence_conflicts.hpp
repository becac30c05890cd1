#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reasoning/solid_body.hpp"
#include "vantage/reconstruction/check_scene.hpp"

// Private: what cannot be at the same time.
namespace vantage::reconstruction::detail {

/// A reason against an object, and its weight.
struct Contradiction {
  std::string reason;  ///< for people; empty: none
  double log_ratio = 0;
};

/// Objects as bodies that hide each other from cameras, and exclude each other. Distances below
/// three standard deviations of a pose, and contact, contradict nothing. Refers to all that it is
/// made of.
class Conflicts {
 public:
  Conflicts(std::span<const CameraView> views, const SceneKnowledge& knowledge,
            std::span<const ReconstructedObject> objects);

  /// A static structure hides a feature of the object from the camera that saw it.
  Contradiction hidden_by_solid(std::size_t object) const;
  /// The object would hide a marker of the board that a camera saw.
  Contradiction hides_board(std::size_t object) const;
  /// The object would stand inside a static structure.
  Contradiction inside_solid(std::size_t object) const;

  /// Why `object` cannot be there if `other` is; empty if both can.
  std::string exclusion(std::size_t object, std::size_t other) const;

 private:
  struct Placed {
    const ReconstructedObject* object = nullptr;
    double slack_m = 0;
    std::shared_ptr<const Scene> body;  ///< without what the slack takes away; null: nothing left
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius_m = 0;
    std::vector<std::vector<Eigen::Vector3d>> seen;  ///< of each support, its points; world frame
  };
  struct Solid {
    const KnownObject* object = nullptr;
    std::shared_ptr<const Scene> scene;
    Eigen::AlignedBox3d bounds;  ///< in its own frame
  };

  const Eigen::Vector3d& eye(std::size_t view) const;
  /// The view from which `front` would hide a feature that was seen of `back`.
  std::optional<std::size_t> view_that_sees_through(const Placed& front, const Placed& back) const;

  std::span<const CameraView> views_;
  const SceneKnowledge& knowledge_;
  std::vector<Placed> placed_;
  std::vector<Solid> solids_;
};

/// What an object's pose may be off by: three standard deviations, and contact.
double slack_of(const ReconstructedObject& object);

}  // namespace vantage::reconstruction::detail
