#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/check_scene.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage {

/// Identifies one object over time: 1, 2, 3, … in the order in which objects were first reported.
/// Never used twice.
using TrackId = std::uint64_t;

/// What the cameras saw at one time.
struct Snapshot {
  double time_s = 0;
  std::span<const CameraView> views;  ///< the same cameras in the same order every time
  /// Depth images of the same time, of these or of other cameras. May be empty.
  std::span<const DepthCamera> depth = {};
};

/// How poses are filtered over time. Thesis, section 6.4.1.
enum class TemporalFilter {
  none,      ///< each snapshot's own pose
  features,  ///< older features count as current ones, with weights that decay
  kalman,    ///< an error-state Kalman filter per object
};

/// How objects are tracked.
struct TrackOptions {
  TemporalFilter filter = TemporalFilter::kalman;
  ReconstructOptions reconstruct = {};
  /// Standard deviation by which a standing object creeps in a second, metres and radians.
  double creep_m = 2e-7, creep_rad = 2e-6;
  /// Filter `features`: the weight of a feature falls by a factor of e in this time.
  double feature_decay_s = 0.5;
  /// Snapshots in which a new object, or an object at a new place, has to be seen alike before it
  /// is reported.
  int confirmations = 2;
  /// Mean times until any one object is moved, and until one is added or taken away.
  double mean_time_to_move_s = 100, mean_time_to_change_s = 1000;
  /// An object that is not where it was may be carried for so long before it is said to have
  /// disappeared. It keeps its id if it comes back later.
  double max_carry_s = 3;
  double min_existence = 0.02;  ///< objects that are less likely to be there have left their place
  /// Smaller steps are corrections of a pose, not moves.
  double min_move_m = 0.003, min_move_rad = 0.03;
};

/// Whether and how an object is seen now.
enum class TrackState {
  standing,  ///< seen where it stood before
  moving,    ///< seen at changing places
  hidden,    ///< not seen, and none of its features could be
  missing,   ///< not seen, although a feature of it should have been
};

/// "standing", "moving", "hidden", "missing".
VANTAGE_API std::string_view name_of(TrackState state);

/// Another object of the same type that this one may be: both went out of sight.
struct AlternativeIdentity {
  TrackId id = 0;  ///< 0: one that was not known before
  double probability = 0;
};

/// An object, followed over time.
struct TrackedObject {
  TrackId id = 0;
  TypePtr type;
  Pose T_world_object;
  /// Of T_world_object. What all pictures of the cameras have in common (the cameras' own poses,
  /// prints, calibration) does not average away over time, and is in it.
  Matrix6d covariance = Matrix6d::Zero();
  TrackState state = TrackState::standing;
  double existence = 1;  ///< the probability that it is still there
  double seen_s = 0;     ///< when it was last seen
  double since_s = 0;    ///< since when it stands where it is
  std::vector<AlternativeIdentity> identities =
      {};                                      ///< likeliest first; empty if there is no doubt
  std::vector<Alternative> alternatives = {};  ///< of the last snapshot that saw it
  std::vector<Support> support = {};           ///< in this snapshot; empty if it was not seen
};

enum class TrackEventKind {
  appeared,        ///< a new object, at a place that was seen to be empty before
  discovered,      ///< a new object, at a place that no camera saw before
  moved,           ///< it stands elsewhere than before; all others stayed unless they say so, too
  disappeared,     ///< it is no longer there
  views_disagree,  ///< one image sees it elsewhere than the others: it moved between two pictures
  taken_back,      ///< it still stands where it was: what was said to be it is another object
};

/// "appeared", "discovered", "moved", "disappeared", "views_disagree", "taken_back".
VANTAGE_API std::string_view name_of(TrackEventKind kind);

/// Something that happened to an object. Thesis, section 5.1.3.
struct TrackEvent {
  TrackEventKind kind = TrackEventKind::appeared;
  double time_s = 0;  ///< of the snapshot that shows it first
  TrackId id = 0;
  TypePtr type;
  std::optional<Pose> from = {}, to = {};  ///< T_world_object before and after, where it has them
  std::string text = {};                   ///< for people
};

/// What is known after a snapshot.
struct TrackedScene {
  double time_s = 0;
  std::vector<TrackedObject> objects;  ///< ascending by id
  std::vector<TrackEvent> events;      ///< found out by this snapshot; in the order of their times
  Reconstruction snapshot;             ///< of this snapshot alone, after `reject_contradicted`
};

/// The objects as the planner sees them, called "<type> #<id>". Objects that are less likely there
/// than not are left out.
VANTAGE_API std::vector<KnownObject> known_objects(const TrackedScene& scene);

/// Follows objects over time: filters their poses, keeps their ids, and says what happened
/// (thesis, sections 5.1.3 and 6.4.1).
///
/// Each snapshot is reconstructed; its objects are assigned to those that are known all at once, by
/// the smallest sum of negative log-likelihoods. An object that is not seen keeps its probability
/// where it is hidden, and loses it where its features should have been seen: rays decide.
/// Not thread-safe; deterministic, the same bits at any number of threads.
class VANTAGE_API ObjectTracker {
 public:
  /// @param scene what hides objects, beside objects: static structures and the board's plate; and
  /// what its `seen_points` say to be visible in every snapshot.
  /// @throws Error bad_input, "options" as the place, for options that are not finite, negative, or
  /// without sense.
  ObjectTracker(std::shared_ptr<const KnowledgeBase> knowledge, SceneKnowledge scene,
                const TrackOptions& options = {});
  ~ObjectTracker();
  ObjectTracker(ObjectTracker&&) noexcept;
  ObjectTracker& operator=(ObjectTracker&&) noexcept;

  /// Runs in the caller's task arena. A reconstruction that `stop` ended is no evidence: the result
  /// then has no objects, and the tracker is as before.
  /// @throws Error bad_input, "snapshot" as the place, for a time that is not after the last one's,
  /// for another number of views; and as `reconstruct_pnp` does. The tracker is then as before.
  TrackedScene update(const Snapshot& snapshot, const StopToken& stop = {});

  /// The same with a reconstruction of the snapshot that is there already, by any method. Filter
  /// `features` makes its own all the same.
  TrackedScene update(const Snapshot& snapshot, Reconstruction reconstruction);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
