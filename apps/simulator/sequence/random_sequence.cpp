#include "simulator/sequence/random_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/placement/placement.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "simulator/sequence/arm_path.hpp"
#include "simulator/sequence/sequence_simulator.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr int kPlaceTries = 60;
constexpr int kQuietInstants = 5;  // before the first event, and after the last
enum class PlannedKind { move, add, take_away };

/// Random numbers, told apart by what they are for.
enum class SequenceDraw { order, object, place, visible, start };

double extent_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) box.extend(vertex.cast<double>());
  return box.diagonal().norm();
}

/// Fills a plan with events, one after the other.
class RandomEvents {
 public:
  RandomEvents(const SequenceScene& scene, const RandomSequence& options)
      : scene_(scene), options_(options) {
    plan_.instants = options.instants;
    plan_.period_s = options.period_s;
    plan_.objects = scene.objects;
  }

  SequencePlan take() {
    const std::vector<PlannedKind> kinds = shuffled_kinds();
    const double room = options_.instants - 2 * kQuietInstants;
    const double slot = kinds.empty() ? room : room / double(kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const double spare = std::max(0.0, slot - options_.carry_instants - 1);
      const int begin =
          kQuietInstants + int(std::floor(double(i) * slot + spare * draw(SequenceDraw::start, i)));
      add(kinds[i], i, begin);
    }
    if (options_.arm) plan_.arm = passing_arm(plan_, scene_.floor, options_.seed);
    return std::move(plan_);
  }

 private:
  double draw(SequenceDraw what, std::size_t event) const {
    return to_unit(sample_hash(options_.seed, event, int(what)));
  }

  std::vector<PlannedKind> shuffled_kinds() const {
    std::vector<PlannedKind> kinds(std::size_t(options_.moves), PlannedKind::move);
    kinds.insert(kinds.end(), std::size_t(options_.added), PlannedKind::add);
    kinds.insert(kinds.end(), std::size_t(options_.taken_away), PlannedKind::take_away);
    for (std::size_t i = kinds.size(); i > 1; --i) {
      const auto other = std::size_t(draw(SequenceDraw::order, i) * double(i));
      std::swap(kinds[i - 1], kinds[std::min(other, i - 1)]);
    }
    return kinds;
  }

  /// Between two instants, so that no picture is taken just then.
  double before(int instant) const { return (instant - 0.5) * options_.period_s; }

  void add(PlannedKind kind, std::size_t event, int begin) {
    if (kind == PlannedKind::add) {
      const SequenceObject& like = scene_.objects[event % scene_.objects.size()];
      SequenceObject object{plan_.objects.size() + 1,
                            fmt::format("{} added {}", like.type->name, plan_.objects.size() + 1),
                            like.type,
                            {}};
      const Pose place = free_place(*like.type, event, before(begin), {});
      object.stays = {{.from_s = before(begin), .T_world_object = place}};
      plan_.objects.push_back(std::move(object));
      return;
    }
    SequenceObject& object = plan_.objects[standing_object(event, before(begin))];
    Stay& last = object.stays.back();
    if (kind == PlannedKind::take_away) {
      last.to_s = before(begin);
      return;
    }
    const int end = begin + options_.carry_instants;
    const Pose place = free_place(*object.type, event, before(begin), &object);
    last.to_s = before(begin);
    last.carried_visibly = draw(SequenceDraw::visible, event) < options_.visible_share;
    object.stays.push_back({.from_s = before(end), .T_world_object = place});
  }

  std::size_t standing_object(std::size_t event, double time_s) const {
    std::vector<std::size_t> standing;
    for (std::size_t i = 0; i < plan_.objects.size(); ++i) {
      const Stay& last = plan_.objects[i].stays.back();
      if (last.from_s < time_s && std::isinf(last.to_s)) standing.push_back(i);
    }
    if (standing.empty()) {
      throw bad_input("moves",
                      "no object is left that could be moved or taken away; plan fewer "
                      "events, or more objects");
    }
    return standing[std::size_t(draw(SequenceDraw::object, event) * double(standing.size()))];
  }

  std::vector<KnownObject> obstacles_without(const SequenceObject* moved) const {
    std::vector<KnownObject> obstacles = scene_.obstacles;
    for (const SequenceObject& other : plan_.objects) {
      if (&other == moved || !std::isinf(other.stays.back().to_s)) continue;
      obstacles.push_back({other.name, other.type->mesh, other.stays.back().T_world_object});
    }
    return obstacles;
  }

  Pose free_place(const ObjectType& type, std::size_t event, double time_s,
                  const SequenceObject* moved) const {
    const std::vector<KnownObject> obstacles = obstacles_without(moved);
    const double away_m = extent_of(*type.mesh);
    for (int attempt = 0; attempt < kPlaceTries; ++attempt) {
      const std::uint64_t seed =
          sample_hash(options_.seed, event, int(SequenceDraw::place), attempt);
      const Pose place =
          place_at_rest(std::vector{type.mesh}, obstacles, {.area = scene_.floor, .seed = seed})[0];
      if (moved != nullptr) {
        const Eigen::Vector3d way =
            place.translation() - moved->stays.back().T_world_object.translation();
        if (way.norm() < away_m) continue;
      }
      if (seen_at(type, place, time_s, moved)) return place;
    }
    throw bad_input("moves",
                    fmt::format("found no place for a {} that cameras see, in {} tries; use fewer "
                                "objects, or more cameras",
                                type.name, kPlaceTries));
  }

  bool seen_at(const ObjectType& type, const Pose& place, double time_s,
               const SequenceObject* moved) const {
    SequenceMoment moment = moment_at(plan_, time_s - plan_.period_s / 4);
    std::erase_if(moment.objects,
                  [&](const ObjectAtTime& o) { return &plan_.objects[o.object] == moved; });
    std::vector<KnownObject> fixed = scene_.fixed;
    fixed.push_back({"moved", type.mesh, place});
    return likely_seen(type, place, scene_.cameras, *scene_of(plan_, moment, fixed));
  }

  const SequenceScene& scene_;
  const RandomSequence& options_;
  SequencePlan plan_;
};

void check_count(int count, int least, const char* name) {
  if (count >= least) return;
  throw bad_input(name, fmt::format("found {}; expected {} or more", count, least));
}

}  // namespace

void RandomSequence::check() const {
  check_count(instants, 1, "instants");
  check_count(moves, 0, "moves");
  check_count(added, 0, "added");
  check_count(taken_away, 0, "taken_away");
  check_count(carry_instants, 1, "carry_instants");
  if (!(visible_share >= 0 && visible_share <= 1)) {
    throw bad_input("visible_share", fmt::format("found {}; expected 0 to 1", visible_share));
  }
  const int events = moves + added + taken_away;
  const double room = instants - 2 * kQuietInstants;
  if (events > 0 && room < events * (carry_instants + 1.0)) {
    throw bad_input(
        "instants",
        fmt::format("found {} for {} events of {} instants; expected {} or more", instants, events,
                    carry_instants, 2 * kQuietInstants + events * (carry_instants + 1)));
  }
}

SequencePlan random_sequence(const SequenceScene& scene, const RandomSequence& options) {
  options.check();
  if (scene.objects.empty() && options.moves + options.added + options.taken_away > 0) {
    throw bad_input("moves", "there are no objects; expected one or more");
  }
  SequencePlan plan = RandomEvents(scene, options).take();
  plan.check();
  return plan;
}

}  // namespace vantage
