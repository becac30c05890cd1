#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "reasoning/presence.hpp"
#include "tracking/detection.hpp"
#include "vantage/reconstruction/tracking.hpp"

namespace vantage::reconstruction::detail {

/// What an object's pose may be as well: a single marker may be tilted two ways.
struct OtherPose {
  PoseFilter filter;
  double log_ratio =
      0;  ///< of its probability to that of the pose that the object is taken to have
};

/// Where an object was seen, at first and since then.
struct Place {
  PoseFilter filter;
  double since_s = 0;              ///< when it was seen there first
  int seen = 1;                    ///< in how many snapshots
  double seen_s = 0;               ///< when it was seen there last
  std::vector<std::size_t> views;  ///< that saw it there last
  std::size_t features = 1;        ///< the most that a snapshot saw it there by
  std::optional<OtherPose> other = {};

  /// Of the pose; if it may be the other one, too, it covers that.
  Matrix6d covariance() const;
};

/// An object's last place, when it is on its way to another one.
struct Departure {
  Pose from;
  double seen_s = 0;      ///< when it was seen there last
  bool watched = true;    ///< it was seen all the way since then
  bool was_gone = false;  ///< it was said to have disappeared
  bool was_sure = true;   ///< that it stood there, and how: by more than one feature
};

/// A time in which an object was not watched, and may have been exchanged for another one.
struct Interval {
  double from_s = 0, to_s = 0;
  bool overlaps(const Interval& other) const { return from_s < other.to_s && other.from_s < to_s; }
};

/// For one view that misses an object since some snapshots: the probabilities that it does so and
/// something unknown hides the object, or nothing does. What hides it tends to stay.
struct MissingStreak {
  double hidden = kViewHidden, clear = 1 - kViewHidden;

  /// @param missed how likely all features are missed where nothing hides the object.
  /// @param something_there depth is measured where the object would be.
  /// @param step_s since the last snapshot.
  void miss(double missed, bool something_there, double step_s);
  double probability() const { return hidden + clear; }
};

/// The logarithm of the probability that all views miss an object as they do.
double log_of(const std::vector<MissingStreak>& streaks);

/// A place at which an object may stand all the same.
struct Doubt {
  Place place;
  std::vector<MissingStreak> streaks;
};

/// An object that is followed, or may become one.
struct Track {
  TrackId id = 0;  ///< 0: not confirmed
  TypePtr type;
  Place place;          ///< where it is taken to be
  bool settled = true;  ///< seen often enough at `place` to say that it stands there
  std::optional<Place> elsewhere = {};      ///< where it was seen since then, but not yet for sure
  std::optional<Departure> departed = {};   ///< from where it stood before; while it is not settled
  std::optional<Doubt> left = {};           ///< a place that it left unseen, if it left it
  double log_odds = 0;                      ///< of being at `place`, before the streaks
  std::vector<MissingStreak> streaks = {};  ///< of each view
  std::optional<double> missing_since_s = {};  ///< first snapshot since when it is not at `place`
  double seen_s = 0;
  bool hidden = false;                     ///< in this snapshot: not seen, and not expected to be
  bool gone = false;                       ///< said to have disappeared
  bool discovered = false;                 ///< when first seen: may have stood there before
  bool disagrees = false;                  ///< the views disagree about it, which was said
  std::optional<Interval> unwatched = {};  ///< during its last move
  std::vector<AlternativeIdentity> identities = {};
  const Detection* detection = nullptr;  ///< of this snapshot

  bool confirmed() const { return id != 0; }
  double missing_log() const { return log_of(streaks); }
  double existence() const { return 1 / (1 + std::exp(-log_odds - missing_log())); }
};

/// Of the sphere around the type's mesh.
double radius_of(const ObjectType& type);

}  // namespace vantage::reconstruction::detail
