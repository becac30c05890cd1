#include "evaluate/reasoning/reasoning_scene.hpp"

#include "simulator/scene/sample_hash.hpp"
#include "workcell/random_objects.hpp"
#include "workcell/sequence/sequence_scene.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kBoardDraw = 101;

/// What the planner is told of the cell beside its objects.
std::vector<KnownObject> known_solids(Workcell cell) {
  cell.foreign_objects.clear();
  return sequence_scene(cell).fixed;
}

/// Corners of the board's markers that each camera's detector finds.
std::vector<std::vector<Eigen::Vector3d>> seen_board(const Workcell& cell,
                                                     const SequenceSimulator& simulator,
                                                     const SequenceMoment& moment, double drop,
                                                     std::uint64_t seed) {
  std::vector<std::vector<Eigen::Vector3d>> seen(simulator.cameras().size());
  if (!cell.board) return seen;
  const auto scene = scene_of(simulator.plan(), moment, simulator.fixed());
  for (std::size_t c = 0; c < seen.size(); ++c) {
    const std::vector<Marker>& markers = cell.board->markers;
    for (std::size_t m = 0; m < markers.size(); ++m) {
      const auto sight = see_marker(markers[m], {}, simulator.cameras()[c], *scene);
      if (!sight) continue;
      const double found = sight->recall * (1 - drop);
      if (to_unit(sample_hash(seed, kBoardDraw, c, m)) >= found) continue;
      const auto corners = markers[m].corners();
      seen[c].insert(seen[c].end(), corners.begin(), corners.end());
    }
  }
  return seen;
}

}  // namespace

ReasoningScene reasoning_scene(const Workcell& workcell, const FeatureSensor& sensor,
                               Perturbation perturbation, std::span<const FeatureKey> keys,
                               const TypeModels& types, std::uint64_t seed) {
  Workcell cell = workcell;
  if (cell.random_objects) cell.random_objects->seed = seed;
  place_random_objects(cell);
  const SequenceScene scene = sequence_scene(cell);
  const SequencePlan plan{.objects = scene.objects};
  const SequenceSimulator simulator(plan, scene.fixed, scene.cameras, sensor, seed);
  const SimulatedInstant instant = simulator.at(0);
  perturbation.seed = seed;
  ReasoningScene result{
      disturbed(instant.views, perturbation, 0, keys), {known_solids(cell), {}, instant.depth}, {}};
  result.knowledge.seen_points =
      seen_board(cell, simulator, instant.truth, perturbation.drop, seed);
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const SequenceObject& object = scene.objects[o];
    result.truth.push_back({.id = object.id,
                            .type = types.index.at(object.type.get()),
                            .T_world_object = object.stays[0].T_world_object,
                            .judged = instant.seen[o]});
  }
  return result;
}

}  // namespace vantage
