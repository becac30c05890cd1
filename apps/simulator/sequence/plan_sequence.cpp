#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/sequence/arm_path.hpp"
#include "simulator/sequence/sequence_settings.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// The object's last stay, which has to reach from before to after a time.
Stay& stay_that_ends(SequencePlan& plan, const std::string& name, double time_s,
                     const std::string& place) {
  const auto object = std::ranges::find(plan.objects, name, &SequenceObject::name);
  if (object == plan.objects.end()) {
    throw bad_input(place, fmt::format("found object '{}'; expected the name of a known object, or "
                                       "of one that is added",
                                       name));
  }
  Stay& last = object->stays.back();
  if (last.from_s < time_s && std::isinf(last.to_s)) return last;
  throw bad_input(place,
                  fmt::format("'{}' does not stand anywhere at {} s; expected a time after "
                              "its last event, which ends at {} s",
                              name, time_s, std::isinf(last.to_s) ? last.from_s : last.to_s));
}

void add_move(SequencePlan& plan, const PlannedMove& move) {
  if (!(move.to_s > move.from_s)) {
    throw bad_input(move.place, fmt::format("found a move from {} s to {} s; expected one that "
                                            "ends after it begins",
                                            move.from_s, move.to_s));
  }
  Stay& last = stay_that_ends(plan, move.object, move.from_s, move.place);
  last.to_s = move.from_s;
  last.carried_visibly = move.visibly;
  const auto object = std::ranges::find(plan.objects, move.object, &SequenceObject::name);
  object->stays.push_back({.from_s = move.to_s, .T_world_object = move.T_world_object});
}

void add_object(SequencePlan& plan, const PlannedAddition& addition) {
  if (std::ranges::find(plan.objects, addition.name, &SequenceObject::name) != plan.objects.end()) {
    throw bad_input(addition.place,
                    fmt::format("found the name '{}' for a second object; expected a name of its "
                                "own",
                                addition.name));
  }
  plan.objects.push_back({plan.objects.size() + 1,
                          addition.name,
                          addition.type,
                          {{.from_s = addition.at_s, .T_world_object = addition.T_world_object}}});
}

/// In the order of their times, whatever their lists are.
SequencePlan planned_sequence(const SequenceScene& scene, const SequenceSettings& settings,
                              std::uint64_t seed) {
  SequencePlan plan{.instants = settings.random.instants,
                    .period_s = settings.random.period_s,
                    .objects = scene.objects};
  for (const PlannedAddition& addition : settings.added) add_object(plan, addition);
  struct Ordered {
    double time_s;
    const PlannedMove* move;
    const PlannedRemoval* removal;
  };
  std::vector<Ordered> events;
  for (const PlannedMove& move : settings.moved) events.push_back({move.from_s, &move, nullptr});
  for (const PlannedRemoval& removal : settings.taken_away) {
    events.push_back({removal.at_s, nullptr, &removal});
  }
  std::ranges::stable_sort(events, {}, &Ordered::time_s);
  for (const Ordered& event : events) {
    if (event.move != nullptr) {
      add_move(plan, *event.move);
    } else {
      const PlannedRemoval& removal = *event.removal;
      stay_that_ends(plan, removal.object, removal.at_s, removal.place).to_s = removal.at_s;
    }
  }
  if (settings.random.arm) plan.arm = passing_arm(plan, scene.floor, seed);
  return plan;
}

std::vector<double> delays_of(const SequenceScene& scene,
                              const std::map<std::string, double>& by_name) {
  if (by_name.empty()) return {};
  std::vector<double> delays(scene.cameras.size(), 0.0);
  for (const auto& [name, delay_s] : by_name) {
    const auto camera = std::ranges::find(scene.cameras, name, &SequenceCamera::name);
    if (camera == scene.cameras.end()) {
      throw bad_input("sequence: delays_s",
                      fmt::format("found camera '{}'; expected the name of one of the workcell's "
                                  "cameras",
                                  name));
    }
    delays[std::size_t(camera - scene.cameras.begin())] = delay_s;
  }
  return delays;
}

}  // namespace

SequencePlan plan_sequence(const SequenceScene& scene, const SequenceSettings& settings,
                           std::uint64_t seed) {
  RandomSequence random = settings.random;
  random.seed = seed;
  const bool has_random = random.moves + random.added + random.taken_away > 0;
  if (settings.has_planned_events() && has_random) {
    throw bad_input("sequence", "it has planned events and numbers of random ones; give either");
  }
  SequencePlan plan = settings.has_planned_events() ? planned_sequence(scene, settings, seed)
                                                    : random_sequence(scene, random);
  plan.camera_delay_s = delays_of(scene, settings.delays_s);
  plan.check();
  return plan;
}

}  // namespace vantage
