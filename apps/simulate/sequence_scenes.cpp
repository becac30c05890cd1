#include "simulate/sequence_scenes.hpp"

namespace vantage {
namespace {

const Eigen::Vector3f kArmColor(0.93f, 0.55f, 0.16f);

/// The cell without what the plan moves.
std::vector<SimulatedBody> fixed_bodies(const Workcell& workcell) {
  Workcell still = workcell;
  std::erase_if(still.known_objects, [](const PlacedObject& o) { return o.type != nullptr; });
  if (!still.board && still.static_structures.empty() && still.known_objects.empty() &&
      still.foreign_objects.empty()) {
    return {};
  }
  return simulated_cell(still).scene.bodies();
}

}  // namespace

SequenceScenes::SequenceScenes(const Workcell& workcell, const SequencePlan& plan)
    : plan_(plan), fixed_(fixed_bodies(workcell)) {
  for (const PlacedObject& object : workcell.known_objects) {
    if (object.type == nullptr) fixed_known_.push_back(object);
  }
}

SceneAtTime SequenceScenes::at(double time_s) {
  const SequenceMoment moment = moment_at(plan_, time_s);
  std::vector<SimulatedBody> bodies = fixed_;
  std::vector<PlacedObject> known_objects = fixed_known_;
  for (const ObjectAtTime& at : moment.objects) {
    const SequenceObject& object = plan_.objects[at.object];
    bodies.push_back({object.name, looks_.of(object.type), at.T_world_object});
    known_objects.push_back(
        {object.name, object.type->mesh, at.T_world_object, object.type, object.type->color});
  }
  for (const ArmPart& part : moment.arm) {
    std::shared_ptr<const TexturedMesh>& look = arm_looks_[part.mesh.get()];
    if (!look) look = std::make_shared<const TexturedMesh>(TexturedMesh{*part.mesh, kArmColor});
    bodies.push_back({part.name, look, part.T_world_part});
  }
  return {SimulatedScene(std::move(bodies)), std::move(known_objects)};
}

}  // namespace vantage
