#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage {

/// What cameras measured at a point of space.
enum class SpaceState { unseen, empty, occupied };
using SpaceProbe = std::function<SpaceState(const Eigen::Vector3d& p_world)>;

/// As depth images have it: empty where one of them sees through, occupied where a surface is
/// measured, else unseen. Depths that differ by less than 1 cm, or 1.5 %, may be the same surface.
/// Thread-safe.
VANTAGE_API SpaceProbe measured_space(std::vector<DepthCamera> cameras);

/// Whether an object can be at rest where it is said to be.
enum class SupportVerdict {
  stands,    ///< what it touches holds it
  unseen,    ///< something has to hold it that no camera could see, or that is not known
  floats,    ///< it touches nothing that stands on something, and what is below is seen to be empty
  tips,      ///< what it touches cannot hold it: it would tip over, or slide
  sinks,     ///< it reaches into the floor
  unjudged,  ///< its mesh is open, so that its centre of mass is unknown
};

enum class SupporterKind {
  floor,
  structure,
  object,
  measured,  ///< a surface that depth images show, and nothing known has
  unseen,    ///< volume that no camera sees
};

struct Supporter {
  SupporterKind kind = SupporterKind::floor;
  std::size_t index = 0;  ///< of structures and objects
  bool operator==(const Supporter&) const = default;
};

/// What holds an object.
struct ObjectSupport {
  SupportVerdict verdict = SupportVerdict::stands;
  std::vector<Supporter> supported_by = {};
  /// Where the support would have to be that no camera sees, or that is not known; world frame.
  std::optional<Eigen::AlignedBox3d> unseen_region = {};
  std::string reason = {};  ///< a clause; empty for what stands
  bool pulled = false;      ///< its pose was pulled to what it stands on
};

struct SupportOptions {
  std::optional<double> floor_z_m = 0.0;  ///< a plane that carries; none: there is no floor
  double friction = 0.5;                  ///< coefficient, between all surfaces
  /// Surfaces that are this far apart may touch, and as much more as the covariances of the poses
  /// leave open, in standard deviations.
  double slack_m = 0.002;
  double sigmas = 3;
  /// How far surfaces that touch are from each other in truth, as a whole and from place to place:
  /// standard deviations, for pulled poses.
  double surface_sigma_m = 0.0003;
  double flatness_sigma_m = 0.0001;
};

/// Whether objects, of even density, can be at rest together: contacts within what their poses
/// leave open, and static equilibrium with Coulomb friction of all that touch each other, as one
/// linear programme. An object that cannot be held may be by something that no camera sees, where
/// `space` does not say that there is nothing.
/// @param structures what stands for certain.
/// @param space none: nothing is known to be empty.
/// Thread-safe; deterministic. World frame, z up.
VANTAGE_API std::vector<ObjectSupport> judge_support(std::span<const ReconstructedObject> objects,
                                                     std::span<const KnownObject> structures,
                                                     const SpaceProbe& space = {},
                                                     const SupportOptions& options = {});

/// Pulls objects that stand to what they stand on, the lowest first: a Bayesian update of pose and
/// covariance by the distances that must be zero. Objects whose covariance contradicts the contact
/// stay where they are. Sets `pulled`.
/// @param support of `judge_support`, for the same objects.
VANTAGE_API void pull_to_contact(std::span<const KnownObject> structures,
                                 const SupportOptions& options, std::vector<ObjectSupport>& support,
                                 std::span<ReconstructedObject> objects);

/// Makes objects that cannot stand less likely, and warns of those that nothing else is said of.
VANTAGE_API void lower_unsupported(std::span<const ObjectSupport> support,
                                   std::span<ReconstructedObject> objects);

}  // namespace vantage
