#include "workcell/simulated_cell.hpp"

#include "workcell/object_appearance.hpp"

namespace vantage {
namespace {

/// Bodies and what they are, side by side.
struct Bodies {
  std::vector<SimulatedBody> shapes;
  std::vector<CellBody> names;
  ObjectLooks looks = {};

  void add_board(const Board& board) {
    shapes.push_back({"board", std::make_shared<const TexturedMesh>(board_shape(board)), {}});
    names.push_back({BodyKind::board, "board", nullptr});
  }
  void add(BodyKind kind, const PlacedObject& object) {
    shapes.push_back({object.name, looks.of(object), object.T_world_object});
    names.push_back({kind, object.name, object.type});
  }
  void add_all(BodyKind kind, const std::vector<PlacedObject>& objects) {
    for (const PlacedObject& object : objects) add(kind, object);
  }
};

}  // namespace

SimulatedCell simulated_cell(const Workcell& workcell) {
  Bodies bodies;
  if (workcell.board) bodies.add_board(*workcell.board);
  bodies.add_all(BodyKind::static_structure, workcell.static_structures);
  bodies.add_all(BodyKind::known_object, workcell.known_objects);
  bodies.add_all(BodyKind::foreign_object, workcell.foreign_objects);
  if (bodies.shapes.empty()) {
    throw bad_input(
        "workcell",
        "the cell is empty; give it a board, static_structures, known_objects or foreign_objects");
  }
  return {SimulatedScene(std::move(bodies.shapes)), std::move(bodies.names)};
}

}  // namespace vantage
