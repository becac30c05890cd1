#include "tracking/track_set.hpp"

#include <algorithm>

#include "reasoning/solid_body.hpp"
#include "tracking/place_update.hpp"
#include "tracking/track_texts.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kMaxLogOdds = 4.6;   ///< of an object that is seen: 99 %
constexpr double kUnsettled = 0.7;    ///< lost in a snapshot by an object that is on its way
constexpr double kRefutedLog = 4;     ///< lost where depth shows that nothing is there
constexpr double kMaxMisses = 2.5;    ///< of a candidate, before it is dropped
constexpr double kWatched_m = 0.1;    ///< steps by which an object can be followed
constexpr int kStart = 5;             ///< snapshots; what comes into sight in them was there
constexpr double kContact_m = 0.004;  ///< objects that touch do not stand inside each other

double log_odds_of(double probability) {
  const double p = std::clamp(probability, 0.5, 0.999);
  return std::min(kMaxLogOdds, std::log(p / (1 - p)));
}

void creep(Place& place, double creep_m, double creep_rad) {
  place.filter.predict(creep_m, creep_rad);
  if (place.other) place.other->filter.predict(creep_m, creep_rad);
}

double chance(double step_s, double mean_s) {
  return std::clamp(1 - std::exp(-step_s / mean_s), 1e-6, 0.5);
}

}  // namespace

std::vector<TrackEvent> TrackSet::update(const SnapshotEvidence& evidence) {
  events_.clear();
  ++snapshots_;
  predict(evidence.step_s);
  take_in(evidence);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Track& track = tracks_[t];
    if (!track.confirmed()) continue;
    check_left(track, evidence);
    check_gone(track, evidence.time_s);
  }
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (!tracks_[t].confirmed()) confirm(t, evidence);
  }
  std::erase_if(tracks_, [](const Track& track) { return !track.type; });
  std::ranges::stable_sort(events_, {}, &TrackEvent::time_s);
  return std::move(events_);
}

void TrackSet::predict(double step_s) {
  const double root = std::sqrt(step_s);
  for (Track& track : tracks_) {
    track.detection = nullptr;
    track.hidden = false;
    creep(track.place, options_.creep_m * root, options_.creep_rad * root);
    if (track.elsewhere)
      creep(*track.elsewhere, options_.creep_m * root, options_.creep_rad * root);
  }
}

TrackSet::Expected TrackSet::expected_of(const Track& track, const SnapshotEvidence& evidence) {
  const Pose& pose = track.place.filter.pose();
  return {evidence.presence->missed_probability(*track.type, pose),
          evidence.presence->depth_at(surface_of(track.type), pose)};
}

void TrackSet::take_in(const SnapshotEvidence& evidence) {
  std::vector<Expected> expected;
  std::vector<double> unseen;
  for (const Track& track : tracks_) {
    expected.push_back(expected_of(track, evidence));
    double log = 0;
    for (std::size_t v = 0; v < evidence.views.size(); ++v) {
      MissingStreak streak = track.streaks[v];
      streak.miss(expected.back().missed[v], expected.back().depth.supports(), evidence.step_s);
      log += std::log(streak.probability() / track.streaks[v].probability());
    }
    unseen.push_back(-log);
  }
  const MotionChances chances{chance(evidence.step_s, options_.mean_time_to_move_s)};
  const auto assigned = assign(tracks_, unseen, evidence.detections, chances);
  std::vector<char> used(evidence.detections.size(), 0);
  const std::size_t known = tracks_.size();
  for (std::size_t t = 0; t < known; ++t) {
    const Detection* detection = assigned[t] ? &evidence.detections[*assigned[t]] : nullptr;
    const auto cost = detection ? cost_of(tracks_[t], *detection, chances) : std::nullopt;
    if (assigned[t]) used[*assigned[t]] = 1;
    if (cost) see(tracks_[t], *detection, *cost, evidence);
    const bool is_there = cost && (cost->continuation == Continuation::at_place ||
                                   cost->continuation == Continuation::corrected);
    if (!is_there) {
      miss(tracks_[t], expected[t], evidence);
    }
    if (tracks_[t].elsewhere &&
        (tracks_[t].elsewhere->seen >= options_.confirmations || tracks_[t].existence() < 0.5)) {
      depart(tracks_[t]);
    }
  }
  for (std::size_t d = 0; d < evidence.detections.size(); ++d) {
    if (!used[d]) start(evidence.detections[d], evidence);
  }
}

void TrackSet::see(Track& track, const Detection& detection, const TrackCost& cost,
                   const SnapshotEvidence& evidence) {
  const DetectedPose& detected = detection.poses[cost.pose];
  track.detection = &detection;
  if (cost.continuation == Continuation::at_place) {
    see_at(track.place, *track.type, detection, evidence.time_s);
    track.elsewhere.reset();
    track.missing_since_s.reset();
    track.streaks.assign(evidence.views.size(), {});
    track.log_odds =
        std::min(kMaxLogOdds, std::max(0.0, track.log_odds) + log_odds_of(detected.probability));
    if (!track.settled && track.place.seen >= options_.confirmations) settle(track);
  } else if (cost.continuation == Continuation::elsewhere) {
    see_at(*track.elsewhere, *track.type, detection, evidence.time_s);
  } else {
    const Pose& last = track.elsewhere ? track.elsewhere->filter.pose() : track.place.filter.pose();
    Place seen = place_of(*track.type, detection, cost.pose,
                          like(*track.type, detected.measured, last), evidence.time_s);
    const bool is_better = seen.features > 1 && track.place.features < 2;
    if (cost.continuation == Continuation::corrected && is_better) {
      seen.since_s = track.place.since_s;
      track.place = std::move(seen);
      track.elsewhere.reset();
    } else {
      see_elsewhere(track, std::move(seen), evidence.time_s - track.seen_s < 1.5 * evidence.step_s);
    }
  }
  track.seen_s = evidence.time_s;
}

/// An object that is on its way is where it was seen last; one that stands stays there until it is
/// seen elsewhere for sure.
void TrackSet::see_elsewhere(Track& track, Place seen, bool in_time) {
  if (track.settled) {
    track.elsewhere = std::move(seen);
    return;
  }
  const double step_m = track.place.filter.innovation({seen.filter.pose()}).head<3>().norm();
  if (!in_time || step_m > kWatched_m) track.departed->watched = false;
  track.place = std::move(seen);
  track.streaks.assign(track.streaks.size(), {});
  track.log_odds = std::max(track.log_odds, 1.0);
}

void TrackSet::miss(Track& track, const Expected& expected, const SnapshotEvidence& evidence) {
  const bool on_its_way = !track.settled && track.detection != nullptr;
  if (on_its_way) return;  // it was seen, and is taken to be there
  if (!track.missing_since_s) track.missing_since_s = evidence.time_s;
  for (std::size_t v = 0; v < track.streaks.size(); ++v) {
    track.streaks[v].miss(expected.missed[v], expected.depth.supports(), evidence.step_s);
  }
  if (expected.depth.refutes()) track.log_odds -= kRefutedLog;
  if (!track.settled) track.log_odds -= kUnsettled;
  const bool expected_somewhere =
      std::ranges::any_of(expected.missed, [](double missed) { return missed < 0.5; });
  track.hidden = !expected_somewhere && !expected.depth.refutes();
}

void TrackSet::depart(Track& track) {
  const bool refuted = track.existence() < 0.5;
  if (track.settled) {
    const double step_m =
        track.place.filter.innovation({track.elsewhere->filter.pose()}).head<3>().norm();
    const bool watched = step_m < kWatched_m, was_sure = track.place.features >= 2;
    track.departed =
        Departure{track.place.filter.pose(), track.place.seen_s, watched, track.gone, was_sure};
    if (!refuted && track.hidden) track.left = Doubt{track.place, track.streaks};
  }
  track.place = std::move(*track.elsewhere);
  track.elsewhere.reset();
  track.settled = false;
  track.missing_since_s.reset();
  track.streaks.assign(track.streaks.size(), {});
  track.log_odds = kMaxLogOdds;
  if (track.place.seen >= options_.confirmations) settle(track);
}

void TrackSet::settle(Track& track) {
  track.settled = true;
  const Pose from = track.departed ? track.departed->from : track.place.filter.pose();
  const Vector6d step = track.place.filter.innovation({from});
  const bool notable = step.head<3>().norm() >= options_.min_move_m ||
                       step.tail<3>().norm() >= options_.min_move_rad;
  const bool corrected = track.departed && !track.departed->was_sure &&
                         step.head<3>().norm() < kSamePlace * radius_of(*track.type);
  if (track.departed && notable && !corrected) {
    doubt_identity(track);
    say(TrackEventKind::moved, track.place.since_s, track, from, track.place.filter.pose());
  } else if (track.departed && track.departed->was_gone) {
    say(TrackEventKind::appeared, track.place.since_s, track, {}, track.place.filter.pose());
  }
  track.departed.reset();
}

void TrackSet::start(const Detection& detection, const SnapshotEvidence& evidence) {
  const DetectedPose& detected = detection.poses.front();
  Track track{0, detected.type,
              place_of(*detected.type, detection, 0, detected.measured, evidence.time_s)};
  track.log_odds = log_odds_of(detected.probability);
  track.streaks.resize(evidence.views.size());
  track.seen_s = evidence.time_s;
  track.detection = &detection;
  tracks_.push_back(std::move(track));
}

/// Whether an object that is known stands there: solids exclude each other, and what is detected
/// beside a known object's pose is that object, taken for another one or turned the wrong way.
bool TrackSet::is_blocked(const Track& candidate) const {
  const ReconstructedObject body{candidate.type, candidate.place.filter.pose()};
  const double reach_m = kSamePlace * radius_of(*candidate.type);
  return std::ranges::any_of(tracks_, [&](const Track& other) {
    if (!other.confirmed() || other.gone || other.existence() < 0.5) return false;
    const ReconstructedObject there{other.type, other.place.filter.pose()};
    const double apart_m =
        (there.T_world_object.translation() - body.T_world_object.translation()).norm();
    const double other_reach_m = kSamePlace * radius_of(*other.type);
    return apart_m < std::min(reach_m, other_reach_m) || overlap(body, there, kContact_m);
  });
}

void TrackSet::confirm(std::size_t candidate, const SnapshotEvidence& evidence) {
  Track& track = tracks_[candidate];
  if (track.detection == nullptr) {
    const bool dropped = evidence.time_s - track.seen_s > kMaxMisses * evidence.step_s;
    if (dropped) track.type = nullptr;
    return;
  }
  const bool sure = evidence.first && track.detection->object->support.size() > 1;
  if (!sure && track.place.seen < options_.confirmations) return;
  if (is_blocked(track)) return;
  if (take_back(track)) {
    tracks_[candidate].type = nullptr;  // tracks may have been added
    return;
  }
  if (Track* known = returned_object(track, evidence.time_s)) {
    known->elsewhere = track.place;
    known->detection = track.detection;
    known->seen_s = evidence.time_s;
    depart(*known);
    known->gone = false;
    track.type = nullptr;
    return;
  }
  track.id = ++last_id_;
  track.log_odds = kMaxLogOdds;
  const Pose& pose = track.place.filter.pose();
  const bool empty = !evidence.first && evidence.before->was_seen_empty(*track.type, pose);
  if (!empty && snapshots_ <= kStart) return;
  say(empty ? TrackEventKind::appeared : TrackEventKind::discovered, track.place.since_s, track, {},
      pose);
}

void TrackSet::check_gone(Track& track, double time_s) {
  if (track.gone || !track.missing_since_s || track.existence() >= options_.min_existence) return;
  if (time_s - *track.missing_since_s < options_.max_carry_s) return;
  track.gone = true;
  const Pose from = track.departed ? track.departed->from : track.place.filter.pose();
  say(TrackEventKind::disappeared, *track.missing_since_s, track, from, {});
}

void TrackSet::say(TrackEventKind kind, double time_s, const Track& track, std::optional<Pose> from,
                   std::optional<Pose> to, const std::string& more) {
  events_.push_back({kind, time_s, track.id, track.type, from, to, {}});
  events_.back().text = text_of(events_.back(), more);
}

const std::vector<SurfacePoint>& TrackSet::surface_of(const TypePtr& type) {
  const auto [found, is_new] = surfaces_.try_emplace(type);
  if (is_new) found->second = surface_points(*type->mesh);
  return found->second;
}

}  // namespace vantage::reconstruction::detail
