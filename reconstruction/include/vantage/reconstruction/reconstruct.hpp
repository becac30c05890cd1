#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage {

/// An observation: `views[view].observations[observation]`.
struct ObservationId {
  std::size_t view = 0;
  std::size_t observation = 0;
  auto operator<=>(const ObservationId&) const = default;
};

/// An observation that supports an object.
struct Support {
  ObservationId id;
  std::size_t feature = 0;  ///< of the object's type
  double residual_px = 0;   ///< root mean square over its points; of a pose or a label: 0
  bool operator==(const Support&) const = default;
};

/// Another explanation of the same observations.
struct Alternative {
  TypePtr type;
  Pose T_world_object;
  double probability = 0;
};

/// What the scene says for an object (above 0) and against it (below 0): natural logarithms of
/// likelihood ratios, one for each kind of evidence. Their sum is the log-odds of the object being
/// there. `reject_contradicted` fills it in.
struct Evidence {
  double seen_features = 0;        ///< features that were seen where it has them
  double missing_features = 0;     ///< features that cameras should have seen, and did not
  double depth = 0;                ///< depth images show its surface, or what lies behind it
  double hidden_by_structure = 0;  ///< structures would hide what was seen of it
  double inside_structure = 0;     ///< it would reach into a structure
  double hides_board = 0;          ///< it would hide markers of the board that were seen
  double other_objects = 0;        ///< it and other objects would hide each other, or overlap
  double wrong_size = 0;           ///< its features fit to each other in another size only
  int features_missing = 0;        ///< features that should have been seen, over all views
  /// Points of its surface, over all depth images: measured there; something behind them, in front.
  int depth_on_surface = 0, depth_behind = 0, depth_in_front = 0;

  VANTAGE_API double log_odds() const;
};

/// An object that was found.
struct ReconstructedObject {
  TypePtr type;
  Pose T_world_object;
  std::optional<Matrix6d> covariance = {};  ///< none: the method has no notion of it
  /// That it is there, of this type, and at this pose rather than at one of the alternatives'.
  double probability = 1;
  double rms_px = 0;                           ///< over the points of all inliers
  std::vector<Support> support = {};           ///< ascending by id
  std::vector<Alternative> alternatives = {};  ///< likeliest first
  std::string warning = {};                    ///< what contradicts it; empty if nothing does
  /// The part of `covariance` that is new in every picture: the noise of the observations. The rest
  /// (the cameras' poses, prints, calibration) is the same in all pictures of the cameras.
  std::optional<Matrix6d> noise_covariance = {};
  std::optional<Evidence> evidence = {};  ///< none: it was not weighed
};

/// An object that explains observations, but is less likely there than not.
struct RejectedObject {
  ReconstructedObject object;
  std::string reason;  ///< for people
};

/// An observation that no object explains.
struct Unexplained {
  ObservationId id;
  std::string reason;
};

/// The result of a reconstruction. Objects in the order of their types, then of their first
/// support.
struct Reconstruction {
  std::vector<ReconstructedObject> objects;
  std::vector<Unexplained> unexplained;  ///< ascending by id
  StopReason stopped = StopReason::none;
  std::vector<RejectedObject> rejected = {};  ///< in the order in which they were rejected
};

/// The objects as the planner sees them, with names that are unique: the type's, and a number where
/// there are several of a type.
/// @param taken names that something else has.
VANTAGE_API std::vector<KnownObject> known_objects(const Reconstruction& result,
                                                   const std::vector<std::string>& taken = {});

/// Bounds that the methods share.
struct ReconstructOptions {
  /// Multi-view PnP, voting: residuals above it belong to something else. Multi-view PnP allows for
  /// three standard deviations more where the pose of a camera has a covariance.
  double inlier_px = 3.0;
  double merge_m = 0.01;       ///< voting: votes that are nearer may be for one object
  double min_evidence = 13.8;  ///< see LocateOptions
  /// An object that a single camera sees by a single marker may be tilted two ways. Off: such
  /// objects are left out, unless one of the two explains its corners clearly better.
  bool keep_ambiguous = true;
};

/// One pose for each type from the corners that single cameras find in space (thesis, section 6.1,
/// with the rotation V Uᵀ). The baseline: one instance of each type, features with 3D points only.
VANTAGE_API Reconstruction reconstruct_svd(std::span<const CameraView> views,
                                           const KnowledgeBase& knowledge,
                                           const ReconstructOptions& options = {},
                                           const StopToken& stop = {});

/// Poses that minimise the reprojection error over all cameras at once; instances by splitting and
/// merging until every residual is below `inlier_px` (thesis, section 6.3). Covariances have the
/// cameras' own in them.
VANTAGE_API Reconstruction reconstruct_pnp(std::span<const CameraView> views,
                                           const KnowledgeBase& knowledge,
                                           const ReconstructOptions& options = {},
                                           const StopToken& stop = {});

/// Poses that most features vote for, of whatever kind they are (thesis, section 6.2): a sparse
/// table over (type, 6DoF), with votes against types that do not carry what is seen.
VANTAGE_API Reconstruction reconstruct_voting(std::span<const CameraView> views,
                                              const KnowledgeBase& knowledge,
                                              const ReconstructOptions& options = {},
                                              const StopToken& stop = {});

}  // namespace vantage
