#include "workcell/sequence/sequence_scene.hpp"

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

KnownObject board_plate(const Board& board) {
  const Eigen::Vector2d half = board.size_m / 2;
  const Box box({-half.x(), -half.y(), -board.thickness_m}, {half.x(), half.y(), 0}, board.place);
  return {"board", std::make_shared<const TriangleMesh>(TriangleMesh::from_box(box)), {}};
}

/// Everything that never moves.
std::vector<KnownObject> fixed_objects(const Workcell& workcell) {
  std::vector<KnownObject> fixed = known(workcell.static_structures);
  for (const KnownObject& object : known(workcell.foreign_objects)) fixed.push_back(object);
  for (const PlacedObject& object : workcell.known_objects) {
    if (object.type == nullptr) fixed.push_back(object.known());
  }
  return fixed;
}

}  // namespace

SequenceScene sequence_scene(const Workcell& workcell, const Distortion& distortion) {
  if (workcell.cameras.empty()) {
    throw bad_input("cameras", "the workcell has none; a sequence needs at least one");
  }
  SequenceScene scene{.objects = {},
                      .floor = random_object_floor(workcell),
                      .obstacles = {},
                      .fixed = fixed_objects(workcell),
                      .cameras = {}};
  scene.obstacles = rising_above(scene.fixed, scene.floor.min().z());
  if (workcell.board) scene.fixed.push_back(board_plate(*workcell.board));
  for (const PlacedObject& object : workcell.known_objects) {
    if (object.type == nullptr) continue;
    scene.objects.push_back({scene.objects.size() + 1,
                             object.name,
                             object.type,
                             {{.T_world_object = object.T_world_object}}});
  }
  for (const CellCamera& camera : workcell.cameras) {
    scene.cameras.push_back(
        {camera.name, camera.camera, Lens(camera.camera.intrinsics(), distortion)});
  }
  return scene;
}

}  // namespace vantage
