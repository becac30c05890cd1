#include <algorithm>

#include "tracking/track_set.hpp"

// Which object is which, where several of a type may have been exchanged out of sight.
namespace vantage::reconstruction::detail {
namespace {

constexpr double kEmptyLog = -3;  ///< a place that was left unseen: the object is not there

/// An object with this probability is the one; the others share the rest by their weights.
std::vector<AlternativeIdentity> shares(std::vector<AlternativeIdentity> weights, double own) {
  double sum = own;
  for (const AlternativeIdentity& other : weights) sum += other.probability;
  for (AlternativeIdentity& other : weights) other.probability /= sum;
  std::ranges::stable_sort(weights, std::greater(), &AlternativeIdentity::probability);
  return weights;
}

}  // namespace

/// An object whose place was hidden when it was seen elsewhere is back at its place: what was seen
/// elsewhere is another object.
bool TrackSet::take_back(const Track& candidate) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Track& track = tracks_[t];
    if (!track.confirmed() || !track.left || track.type != candidate.type) continue;
    const PoseMeasurement seen =
        like(*track.type, candidate.place.filter.state(), track.left->place.filter.pose());
    const NormalLikelihood likelihood =
        likelihood_of(track.left->place.filter.innovation(seen),
                      track.left->place.filter.innovation_covariance(seen, false));
    if (likelihood.squared_distance > kGate) continue;
    Track other = track;
    other.id = ++last_id_;
    other.left.reset();
    other.identities.clear();
    track.place = candidate.place;
    track.settled = true;
    track.elsewhere.reset();
    track.departed.reset();
    track.left.reset();
    track.detection = candidate.detection;
    track.seen_s = candidate.seen_s;
    track.log_odds = other.log_odds;
    track.streaks.assign(track.streaks.size(), {});
    track.missing_since_s.reset();
    track.identities.clear();
    say(TrackEventKind::taken_back, candidate.place.since_s, track, other.place.filter.pose(),
        track.place.filter.pose(), "#" + std::to_string(other.id));
    say(TrackEventKind::appeared, other.place.since_s, other, {}, other.place.filter.pose());
    tracks_.push_back(std::move(other));
    return true;
  }
  return false;
}

/// Of the objects of its type that are not where they were, that which is likeliest to be this one;
/// null if a new one is likelier.
Track* TrackSet::returned_object(const Track& candidate, double time_s) {
  const auto chance_since = [&](double since_s, double mean_s) {
    return 1 - std::exp(-std::max(time_s - since_s, 0.0) / mean_s);
  };
  Track* best = nullptr;
  std::vector<AlternativeIdentity> weights;
  double best_weight = chance_since(candidate.place.since_s, options_.mean_time_to_change_s);
  const double as_new = best_weight;
  for (Track& track : tracks_) {
    if (!track.confirmed() || track.type != candidate.type || track.detection != nullptr) continue;
    if (track.place.seen_s >= candidate.place.since_s) continue;  // both were seen
    // It moved, or it stands where it was and is missed there as it is.
    const double moved = chance_since(track.place.seen_s, options_.mean_time_to_move_s);
    double weight = std::min(1.0, moved / std::exp(track.missing_log()));
    if (track.existence() < 0.5) weight = track.gone ? 0.5 : 1;
    if (weight > best_weight) best = &track, best_weight = weight;
    weights.push_back({track.id, weight});
  }
  if (best == nullptr) return nullptr;
  weights.push_back({0, as_new});
  const TrackId chosen = best->id;
  std::erase_if(weights, [&](const AlternativeIdentity& other) { return other.id == chosen; });
  best->identities = shares(std::move(weights), best_weight);
  std::erase_if(best->identities, [](const auto& other) { return other.probability < 0.01; });
  return best;
}

/// Others of its type that were out of sight while it was, too, may be this one.
void TrackSet::doubt_identity(Track& track) {
  if (track.departed->watched) return;
  track.unwatched = Interval{track.departed->seen_s, track.place.since_s};
  for (Track& other : tracks_) {
    if (&other == &track || !other.confirmed() || other.type != track.type) continue;
    const bool was_away = other.unwatched && other.unwatched->overlaps(*track.unwatched);
    if (!was_away) continue;
    const auto doubt = [](Track& a, const Track& b) {
      std::erase_if(a.identities, [&](const auto& known) { return known.id == b.id; });
      double own = 1;
      for (const AlternativeIdentity& known : a.identities) own -= known.probability;
      a.identities.push_back({b.id, own});
      a.identities = shares(std::move(a.identities), own);
    };
    doubt(track, other);
    doubt(other, track);
  }
}

/// Whether the place that an object left unseen is empty by now.
void TrackSet::check_left(Track& track, const SnapshotEvidence& evidence) {
  if (!track.left) return;
  const Pose& pose = track.left->place.filter.pose();
  const auto missed = evidence.presence->missed_probability(*track.type, pose);
  const DepthAtObject depth = evidence.presence->depth_at(surface_of(track.type), pose);
  for (std::size_t v = 0; v < missed.size(); ++v) {
    track.left->streaks[v].miss(missed[v], depth.supports(), evidence.step_s);
  }
  if (!depth.refutes() && log_of(track.left->streaks) > kEmptyLog) return;
  track.left.reset();
  std::erase_if(track.identities, [](const auto& other) { return other.id == 0; });
}

}  // namespace vantage::reconstruction::detail
