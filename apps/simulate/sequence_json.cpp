#include <algorithm>
#include <cmath>

#include "cli/pose_json.hpp"
#include "simulate/sequence_recording.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json instant_json(const SequencePlan& plan, int instant, std::size_t cameras) {
  Json json{{"folder", instant_folder(instant)},
            {"time_s", plan.time_s(instant)},
            {"camera_times_s", Json::array()},
            {"objects", Json::array()}};
  for (std::size_t c = 0; c < cameras; ++c) {
    json["camera_times_s"].push_back(plan.time_s(instant) + plan.delay_s(c));
  }
  for (const ObjectAtTime& at : moment_at(plan, plan.time_s(instant)).objects) {
    json["objects"].push_back({{"id", plan.objects[at.object].id},
                               {"carried", at.carried},
                               {"T_world_object", to_json(at.T_world_object)}});
  }
  return json;
}

/// What happened to one object.
void add_events(const SequenceObject& object, Json& events) {
  const auto add = [&](const char* kind, double from_s, double to_s, const Stay* from,
                       const Stay* to) {
    events.push_back({{"kind", kind},
                      {"id", object.id},
                      {"from_s", from_s},
                      {"to_s", to_s},
                      {"from", from == nullptr ? Json() : to_json(from->T_world_object)},
                      {"to", to == nullptr ? Json() : to_json(to->T_world_object)}});
  };
  const std::vector<Stay>& stays = object.stays;
  if (stays.front().from_s > 0) {
    add("appeared", stays.front().from_s, stays.front().from_s, nullptr, &stays.front());
  }
  for (std::size_t i = 0; i + 1 < stays.size(); ++i) {
    add("moved", stays[i].to_s, stays[i + 1].from_s, &stays[i], &stays[i + 1]);
  }
  if (std::isfinite(stays.back().to_s)) {
    add("disappeared", stays.back().to_s, stays.back().to_s, &stays.back(), nullptr);
  }
}

}  // namespace

Json sequence_to_json(const SequencePlan& plan, const Workcell& workcell) {
  Json json{{"vantage", kVersion},         {"period_s", plan.period_s}, {"cameras", Json::array()},
            {"arm", plan.arm.has_value()}, {"objects", Json::array()},  {"events", Json::array()},
            {"instants", Json::array()}};
  for (const CellCamera& camera : workcell.cameras) json["cameras"].push_back(camera.name);
  std::vector<Json> events;
  for (const SequenceObject& object : plan.objects) {
    json["objects"].push_back(
        {{"id", object.id}, {"name", object.name}, {"type", object.type->name}});
    Json own = Json::array();
    add_events(object, own);
    events.insert(events.end(), own.begin(), own.end());
  }
  std::ranges::stable_sort(events, {}, [](const Json& e) { return e["from_s"].get<double>(); });
  json["events"] = events;
  for (int i = 0; i < plan.instants; ++i) {
    json["instants"].push_back(instant_json(plan, i, workcell.cameras.size()));
  }
  return json;
}

}  // namespace vantage
