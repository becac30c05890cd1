#pragma once

#include <map>
#include <vector>

#include "simulator/sequence/sequence_plan.hpp"
#include "workcell/object_appearance.hpp"
#include "workcell/simulated_cell.hpp"

namespace vantage {

/// What cameras see at one time of a sequence.
struct SceneAtTime {
  SimulatedScene scene;
  std::vector<PlacedObject> known_objects;  ///< of the plan, and those that never move
};

/// A workcell over time, with its objects' looks and the arm, which is foreign. Not for many
/// threads at once.
class SequenceScenes {
 public:
  /// @param workcell its known objects of a type are the plan's. Both have to outlive this.
  /// @throws Error bad_input as `simulated_cell` does.
  SequenceScenes(const Workcell& workcell, const SequencePlan& plan);

  SceneAtTime at(double time_s);

 private:
  const SequencePlan& plan_;
  std::vector<SimulatedBody> fixed_;
  std::vector<PlacedObject> fixed_known_;
  ObjectLooks looks_ = {};
  std::map<const TriangleMesh*, std::shared_ptr<const TexturedMesh>> arm_looks_ = {};
};

}  // namespace vantage
