#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracking/feature_filter.hpp"
#include "tracking/occluders.hpp"
#include "tracking/track_set.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/tracking.hpp"

namespace vantage {
namespace {

using namespace reconstruction::detail;

void check(const TrackOptions& options) {
  const auto positive = [](const char* name, double value) {
    if (value > 0 && std::isfinite(value)) return;
    throw bad_input("options",
                    fmt::format("found {} = {}; expected a positive number", name, value));
  };
  positive("creep_m", options.creep_m);
  positive("creep_rad", options.creep_rad);
  positive("feature_decay_s", options.feature_decay_s);
  positive("mean_time_to_move_s", options.mean_time_to_move_s);
  positive("mean_time_to_change_s", options.mean_time_to_change_s);
  positive("max_carry_s", options.max_carry_s);
  positive("min_move_m", options.min_move_m);
  positive("min_move_rad", options.min_move_rad);
  if (options.confirmations < 1) {
    throw bad_input("options", fmt::format("found confirmations = {}; expected 1 or more",
                                           options.confirmations));
  }
  if (!(options.min_existence > 0 && options.min_existence < 0.5)) {
    throw bad_input("options", fmt::format("found min_existence = {}; expected a probability above "
                                           "0 and below 0.5",
                                           options.min_existence));
  }
}

TrackState state_of(const Track& track) {
  if (track.detection != nullptr) {
    return track.settled && !track.elsewhere ? TrackState::standing : TrackState::moving;
  }
  return track.hidden ? TrackState::hidden : TrackState::missing;
}

/// Of the poses of its detection, those that it was not taken for.
std::vector<Alternative> alternatives_of(const Track& track) {
  std::vector<Alternative> alternatives;
  for (const Alternative& other : track.detection->object->alternatives) {
    const Vector6d step = track.place.filter.innovation({other.T_world_object});
    const bool same = other.type == track.type && step.norm() < 1e-6;
    if (!same) alternatives.push_back(other);
  }
  return alternatives;
}

}  // namespace

struct ObjectTracker::Impl {
  std::shared_ptr<const KnowledgeBase> knowledge;
  SceneKnowledge scene;
  TrackOptions options;
  TrackSet tracks;
  Occluders occluders;
  History history;
  FeatureFilter features;
  std::optional<double> time_s = {};
  std::size_t views = 0;  ///< of each snapshot
  std::map<TrackId, bool> disagrees = {};

  Reconstruction reconstruct(const Snapshot& snapshot, const StopToken& stop) const {
    Reconstruction result = reconstruct_pnp(snapshot.views, *knowledge, options.reconstruct, stop);
    SceneKnowledge now = scene;
    now.depth.assign(snapshot.depth.begin(), snapshot.depth.end());
    reject_contradicted(snapshot.views, now, result);
    warn_of_motion(snapshot.views, *knowledge, options.reconstruct, stop, result);
    return result;
  }

  TrackedScene update(const Snapshot& snapshot, Reconstruction reconstruction) {
    TrackedScene result{snapshot.time_s, {}, {}, std::move(reconstruction)};
    const std::vector<Detection> detections = detections_of(result.snapshot, snapshot.views);
    const auto solid = occluders.update(tracks.tracks(), snapshot.views);
    const Presence presence(snapshot.views, snapshot.depth, *solid);
    const double step_s = time_s ? snapshot.time_s - *time_s : 0;
    result.events = tracks.update(
        {snapshot.time_s, step_s, !time_s, snapshot.views, detections, &presence, &history});
    history.add(snapshot.time_s, snapshot.views, snapshot.depth, solid);
    time_s = snapshot.time_s;
    views = snapshot.views.size();
    for (const Track& track : tracks.tracks()) {
      if (!track.confirmed()) continue;
      warn_of_views(track, result);
      if (!track.gone) result.objects.push_back(object_of(track, snapshot));
    }
    std::ranges::sort(result.objects, {}, &TrackedObject::id);
    return result;
  }

  TrackedObject object_of(const Track& track, const Snapshot& snapshot) {
    TrackedObject object{track.id, track.type, track.place.filter.pose()};
    object.covariance = track.place.covariance();
    object.state = state_of(track);
    object.existence = track.existence();
    object.seen_s = track.seen_s;
    object.since_s = track.place.since_s;
    object.identities = track.identities;
    const bool at_place = track.detection != nullptr && !track.elsewhere;
    if (!at_place) return object;
    object.support = track.detection->object->support;
    object.alternatives = alternatives_of(track);
    if (options.filter != TemporalFilter::kalman) refilter(track, snapshot, object);
    return object;
  }

  /// With the other filters the tracks' own one only assigns.
  void refilter(const Track& track, const Snapshot& snapshot, TrackedObject& object) {
    const ReconstructedObject& seen = *track.detection->object;
    const bool likeliest = seen.type == track.type;
    if (!likeliest) return;
    PoseMeasurement measured{
        seen.T_world_object,
        seen.covariance.value_or(track.detection->poses.front().measured.noise), Matrix6d::Zero()};
    if (options.filter == TemporalFilter::features) {
      measured = features.update(track.id, seen, track.place, snapshot.time_s, snapshot.views);
    }
    object.T_world_object =
        nearest_equal_pose(*track.type, measured.T_world_object, track.place.filter.pose());
    object.covariance = measured.noise;
  }

  void warn_of_views(const Track& track, TrackedScene& result) {
    const bool now = track.detection != nullptr && !track.detection->object->warning.empty();
    bool& said = disagrees[track.id];
    if (now && !said) {
      TrackEvent event{TrackEventKind::views_disagree, result.time_s, track.id, track.type};
      event.to = track.place.filter.pose();
      event.text =
          fmt::format("{} #{}: {}", track.type->name, track.id, track.detection->object->warning);
      result.events.push_back(std::move(event));
    }
    said = now;
  }
};

ObjectTracker::ObjectTracker(std::shared_ptr<const KnowledgeBase> knowledge, SceneKnowledge scene,
                             const TrackOptions& options) {
  check(options);
  Occluders occluders(scene.solids);
  impl_ = std::make_unique<Impl>(Impl{std::move(knowledge), std::move(scene), options,
                                      TrackSet(options), std::move(occluders), History(),
                                      FeatureFilter(options.feature_decay_s)});
}

ObjectTracker::~ObjectTracker() = default;
ObjectTracker::ObjectTracker(ObjectTracker&&) noexcept = default;
ObjectTracker& ObjectTracker::operator=(ObjectTracker&&) noexcept = default;

TrackedScene ObjectTracker::update(const Snapshot& snapshot, const StopToken& stop) {
  return update(snapshot, impl_->reconstruct(snapshot, stop));
}

TrackedScene ObjectTracker::update(const Snapshot& snapshot, Reconstruction reconstruction) {
  if (!std::isfinite(snapshot.time_s) || (impl_->time_s && snapshot.time_s <= *impl_->time_s)) {
    throw bad_input("snapshot", fmt::format("found time_s = {}; expected a time after {} s",
                                            snapshot.time_s, impl_->time_s.value_or(-INFINITY)));
  }
  if (impl_->time_s && snapshot.views.size() != impl_->views) {
    throw bad_input("snapshot",
                    fmt::format("found {} views; expected {}, as before; leave the pose "
                                "of a camera empty that took no picture",
                                snapshot.views.size(), impl_->views));
  }
  if (reconstruction.stopped != StopReason::none) {
    return {snapshot.time_s, {}, {}, std::move(reconstruction)};
  }
  return impl_->update(snapshot, std::move(reconstruction));
}

std::vector<KnownObject> known_objects(const TrackedScene& scene) {
  std::vector<KnownObject> objects;
  for (const TrackedObject& object : scene.objects) {
    if (object.existence < 0.5) continue;
    KnownObject known{fmt::format("{} #{}", object.type->name, object.id),
                      object.type->mesh,
                      object.T_world_object,
                      object.type->name,
                      object.covariance,
                      object.existence,
                      {}};
    for (const Alternative& other : object.alternatives) {
      known.alternatives.push_back(
          {other.type->name, other.type->mesh, other.T_world_object, other.probability});
    }
    objects.push_back(std::move(known));
  }
  return objects;
}

}  // namespace vantage
