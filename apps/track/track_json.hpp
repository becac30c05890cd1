#pragma once

#include <nlohmann/json.hpp>

#include "reconstruct/scene_reconstruction.hpp"
#include "vantage/reconstruction/tracking.hpp"

namespace vantage {

/// A line of events.jsonl.
nlohmann::ordered_json to_json(const TrackEvent& event);

/// Of a snapshot, for track.json: which objects are where.
nlohmann::ordered_json instant_json(const std::string& folder, const TrackedScene& scene);

/// The tracked objects as if the snapshot had been reconstructed so: for world.json and pictures.
Reconstruction as_reconstruction(const TrackedScene& scene);

/// "red_cube #3", in the order of `as_reconstruction`.
std::vector<KnownObject> named_objects(const TrackedScene& scene);

/// Adds what only tracking knows to a world.json of `as_reconstruction(scene)`.
void add_tracking(const TrackedScene& scene, nlohmann::ordered_json& world);

/// For people: what happened, and what stands there at the end.
/// @param track track.json.
std::string summary_of_track(const nlohmann::ordered_json& track);

}  // namespace vantage
