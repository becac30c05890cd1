#include "track/track_json.hpp"

#include <fmt/format.h>

#include "cli/pose_json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const std::optional<Pose>& pose) {
  return pose ? to_json(*pose) : Json();
}

Json identities_json(const TrackedObject& object) {
  Json list = Json::array();
  for (const AlternativeIdentity& other : object.identities) {
    list.push_back({{"id", other.id}, {"probability", other.probability}});
  }
  return list;
}

std::string name_of(const TrackedObject& object) {
  return fmt::format("{} #{}", object.type->name, object.id);
}

std::string place_text(const Json& pose) {
  const auto at = [&](std::size_t i) { return pose["translation_m"][i].get<double>() + 0.0; };
  return fmt::format("({:.4f}, {:.4f}, {:.4f}) m", at(0), at(1), at(2));
}

}  // namespace

Json to_json(const TrackEvent& event) {
  return {{"time_s", event.time_s},   {"event", name_of(event.kind)},  {"id", event.id},
          {"type", event.type->name}, {"from", pose_json(event.from)}, {"to", pose_json(event.to)},
          {"text", event.text}};
}

Json instant_json(const std::string& folder, const TrackedScene& scene) {
  Json objects = Json::array();
  for (const TrackedObject& object : scene.objects) {
    objects.push_back({{"id", object.id},
                       {"type", object.type->name},
                       {"state", name_of(object.state)},
                       {"existence", object.existence},
                       {"T_world_object", to_json(object.T_world_object)}});
  }
  return {{"folder", folder}, {"time_s", scene.time_s}, {"objects", objects}};
}

Reconstruction as_reconstruction(const TrackedScene& scene) {
  Reconstruction result{{}, scene.snapshot.unexplained, scene.snapshot.stopped};
  for (const TrackedObject& object : scene.objects) {
    ReconstructedObject as{object.type, object.T_world_object};
    as.covariance = object.covariance;
    as.probability = object.existence;
    as.support = object.support;
    as.alternatives = object.alternatives;
    for (const ReconstructedObject& seen : scene.snapshot.objects) {
      if (seen.support != object.support || object.support.empty()) continue;
      as.rms_px = seen.rms_px;
      as.warning = seen.warning;
      as.evidence = seen.evidence;
    }
    result.objects.push_back(std::move(as));
  }
  result.rejected = scene.snapshot.rejected;
  return result;
}

std::vector<KnownObject> named_objects(const TrackedScene& scene) {
  std::vector<KnownObject> objects;
  for (const TrackedObject& object : scene.objects) {
    objects.push_back({name_of(object),
                       object.type->mesh,
                       object.T_world_object,
                       object.type->name,
                       object.covariance,
                       object.existence,
                       {}});
  }
  return objects;
}

void add_tracking(const TrackedScene& scene, Json& world) {
  world["time_s"] = scene.time_s;
  world["events"] = Json::array();
  for (const TrackEvent& event : scene.events) world["events"].push_back(to_json(event));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const TrackedObject& object = scene.objects[i];
    world["objects"][i].update({{"id", object.id},
                                {"state", name_of(object.state)},
                                {"seen_s", object.seen_s},
                                {"since_s", object.since_s},
                                {"identities", identities_json(object)}});
  }
}

std::string summary_of_track(const Json& track) {
  const Json& instants = track["instants"];
  std::string text =
      fmt::format("{} instants, {} events\n", instants.size(), track["events"].size());
  for (const Json& event : track["events"]) {
    text += fmt::format("  {:>9.3f} s  {}\n", event["time_s"].get<double>(),
                        event["text"].get<std::string>());
  }
  if (instants.empty()) return text;
  text += fmt::format("objects at {:.3f} s\n", instants.back()["time_s"].get<double>());
  for (const Json& object : instants.back()["objects"]) {
    text += fmt::format(
        "  {:<24} {:<9} {:>5.1f} %  {}\n",
        fmt::format("{} #{}", object["type"].get<std::string>(), object["id"].get<TrackId>()),
        object["state"].get<std::string>(), 100 * object["existence"].get<double>(),
        place_text(object["T_world_object"]));
  }
  return text;
}

}  // namespace vantage
