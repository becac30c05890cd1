#pragma once

#include <map>
#include <memory>
#include <vector>

#include "tracking/history.hpp"
#include "tracking/track_costs.hpp"

namespace vantage::reconstruction::detail {

/// A snapshot as the tracks are updated by it.
struct SnapshotEvidence {
  double time_s = 0;
  double step_s = 0;   ///< since the last one
  bool first = false;  ///< nothing was known before: what is seen was there
  std::span<const CameraView> views;
  std::span<const Detection> detections;
  const Presence* presence = nullptr;
  const History* before = nullptr;  ///< without this snapshot
};

/// All objects that are followed, and what becomes of them.
class TrackSet {
 public:
  explicit TrackSet(const TrackOptions& options) : options_(options) {}

  const std::vector<Track>& tracks() const { return tracks_; }

  /// @returns what happened, in the order of times.
  std::vector<TrackEvent> update(const SnapshotEvidence& evidence);

 private:
  /// What this snapshot expects of a track's object, and shows where it would be.
  struct Expected {
    std::vector<double> missed;  ///< by view: how likely it misses all features
    DepthAtObject depth;
  };

  void predict(double step_s);
  Expected expected_of(const Track& track, const SnapshotEvidence& evidence);
  void take_in(const SnapshotEvidence& evidence);
  void see(Track& track, const Detection& detection, const TrackCost& cost,
           const SnapshotEvidence& evidence);
  void see_elsewhere(Track& track, Place seen, bool in_time);
  void miss(Track& track, const Expected& expected, const SnapshotEvidence& evidence);
  void depart(Track& track);
  void settle(Track& track);
  void start(const Detection& detection, const SnapshotEvidence& evidence);
  void confirm(std::size_t candidate, const SnapshotEvidence& evidence);
  bool is_blocked(const Track& candidate) const;
  bool take_back(const Track& candidate);
  Track* returned_object(const Track& candidate, double time_s);
  void doubt_identity(Track& track);
  void check_left(Track& track, const SnapshotEvidence& evidence);
  void check_gone(Track& track, double time_s);
  void say(TrackEventKind kind, double time_s, const Track& track, std::optional<Pose> from,
           std::optional<Pose> to, const std::string& more = {});
  const std::vector<SurfacePoint>& surface_of(const TypePtr& type);

  TrackOptions options_;
  std::vector<Track> tracks_;
  std::vector<TrackEvent> events_;  // of the snapshot that is being taken in
  TrackId last_id_ = 0;
  int snapshots_ = 0;
  std::map<TypePtr, std::vector<SurfacePoint>> surfaces_;
};

}  // namespace vantage::reconstruction::detail
