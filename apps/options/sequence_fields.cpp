#include "options/sequence_fields.hpp"

#include "documents/value_readers.hpp"
#include "options/field_json.hpp"

namespace vantage {

FieldGroup fields_of(RandomSequence& sequence) {
  constexpr double kMany = 1e5;
  return {"sequence",
          "Sequence",
          {{.key = "instants",
            .value = &sequence.instants,
            .help = "Number of instants at which all cameras take a picture",
            .option = "--instants",
            .range = from_to(1, kMany)},
           {.key = "period_s",
            .value = &sequence.period_s,
            .help = "Time from one instant to the next",
            .option = "--period-s",
            .unit = "s",
            .range = from_to(1e-3, 1e4)},
           {.key = "moves",
            .value = &sequence.moves,
            .help = "Number of times that an object is moved to another place",
            .option = "--moves",
            .range = from_to(0, kMany)},
           {.key = "added",
            .value = &sequence.added,
            .help = "Number of objects that are added",
            .option = "--added",
            .range = from_to(0, kMany)},
           {.key = "taken_away",
            .value = &sequence.taken_away,
            .help = "Number of objects that are taken away",
            .option = "--taken-away",
            .range = from_to(0, kMany)},
           {.key = "carry_instants",
            .value = &sequence.carry_instants,
            .help = "Number of instants that a move takes",
            .option = "--carry-instants",
            .range = from_to(1, 1000),
            .expert = true},
           {.key = "visible_share",
            .value = &sequence.visible_share,
            .help = "Share of the moves through the air; in the others a closed hand hides the "
                    "object",
            .option = "--visible-share",
            .range = from_to(0, 1),
            .expert = true},
           {.key = "arm",
            .value = &sequence.arm,
            .help = "An arm carries the objects, and passes over the table in between"}}};
}

SequenceSettings read_sequence(const Value& value, const KnowledgeBase& knowledge) {
  SequenceSettings settings;
  const auto each = [&](const char* key, auto&& read) {
    if (!value.has(key)) return;
    for (const Value& event : value[key].elements()) read(event);
  };
  each("move_objects", [&](const Value& event) {
    settings.moved.push_back({event["object"].as<std::string>(), event["from_s"].as<double>(),
                              event["to_s"].as<double>(), read_pose(event["pose"]),
                              event.get("visibly", true), event.place()});
  });
  each("add_objects", [&](const Value& event) {
    const Value type = event["type"];
    settings.added.push_back({event["at_s"].as<double>(), event["name"].as<std::string>(),
                              knowledge.get(type.as<std::string>(), type.place()),
                              read_pose(event["pose"]), event.place()});
  });
  each("take_objects", [&](const Value& event) {
    settings.taken_away.push_back(
        {event["at_s"].as<double>(), event["object"].as<std::string>(), event.place()});
  });
  if (settings.has_planned_events()) settings.random.moves = 0;
  read_fields(value, fields_of(settings.random));
  each("delays", [&](const Value& delay) {
    settings.delays_s[delay["camera"].as<std::string>()] = delay["delay_s"].as<double>();
  });
  return settings;
}

}  // namespace vantage
