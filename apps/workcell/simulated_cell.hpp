#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/scene/simulated_scene.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

enum class BodyKind { board, static_structure, known_object, foreign_object };

/// Which thing of the workcell a body of the simulated scene is.
struct CellBody {
  BodyKind kind;
  std::string name;
  TypePtr type;  ///< null: of no type of the knowledge base
};

/// The workcell as simulated cameras see it.
struct SimulatedCell {
  SimulatedScene scene;
  std::vector<CellBody> bodies;  ///< one for each of the scene's, in the same order
};

/// The board first, then static structures, known objects and foreign objects, each in the order of
/// the file. Random objects are there if `place_random_objects` put them there.
/// Markers are printed on the types that are there.
/// @throws Error bad_input as `SimulatedScene`, `board_shape` and `ObjectLooks` do, and for a cell
/// in which nothing stands.
SimulatedCell simulated_cell(const Workcell& workcell);

}  // namespace vantage
