#include "simulate/workcell_export.hpp"

#include <doctest/doctest.h>

#include "support/test_data.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCell =
    "work_area: {min_m: [-0.2, -0.2, 0], max_m: [0.2, 0.2, 0.2]}\n"
    "knowledge_base: [types/types.yaml, models, types/types.yaml]\n"
    "board: board.yaml\n"
    "static_structures: [{name: post, mesh: part.ply, pose: {translation_m: [0.15, 0.15, 0.05]}}]\n"
    "foreign_objects: [{name: hand, shape: {sphere: {radius_m: 0.02}}}]\n"
    "known_objects: [{name: model, type: obj_000002, pose: {translation_m: [0, 0, 0.05]}}]\n"
    "random_objects: {count: 3, types: [nut], seed: 4}\n";

/// A cell whose types and static structures have meshes of one name in different folders.
fs::path write_cell(const test::TemporaryFolder& folder) {
  fs::create_directories(folder / "types");
  write_ply(folder / "part.ply", box_solid({0.02, 0.02, 0.1}));
  write_ply(folder / "types/part.ply", box_solid({0.03, 0.03, 0.03}));
  folder.write("types/types.yaml",
               "object_types: [{name: nut, shape: {mesh: {file: part.ply}}}]\n");
  fs::create_directories(folder / "models");
  write_ply(folder / "models/obj_000002.ply", box_solid({30, 30, 30}));
  folder.write("models/models_info.json", R"({"2": {"symmetries_continuous": []}})");
  folder.write("models/notes.txt", "not needed");
  folder.write("board.yaml", "{size_m: [0.4, 0.4], dictionary: 4X4_50, markers: []}\n");
  return folder.write("cell.yaml", kCell);
}

}  // namespace

TEST_CASE("a bundled cell is the same where it was moved to, without the files that it came from") {
  const test::TemporaryFolder folder, other;
  const Workcell cell = [&] {
    const test::TemporaryFolder source;
    const fs::path file = write_cell(source);
    Workcell loaded = load_workcell(file);
    place_random_objects(loaded);
    write_cell_bundle(file, loaded, {}, folder.path());
    return loaded;
  }();
  fs::copy(folder.path(), other / "moved", fs::copy_options::recursive);
  fs::remove_all(folder / "cell");
  const Workcell moved = load_workcell(other / "moved/workcell.yaml");

  CHECK_FALSE(moved.random_objects);
  REQUIRE(moved.known_objects.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const PlacedObject &was = cell.known_objects[i], &is = moved.known_objects[i];
    CHECK(is.name == was.name);
    CHECK(is.type->name == (i == 0 ? "obj_000002" : "nut"));
    CHECK((is.T_world_object.translation() - was.T_world_object.translation()).norm() < 1e-12);
    CHECK((is.T_world_object.rotation() - was.T_world_object.rotation()).norm() < 1e-12);
    CHECK(is.mesh->vertices() == was.mesh->vertices());
  }
  CHECK(moved.static_structures[0].mesh->vertices() == cell.static_structures[0].mesh->vertices());
  CHECK(moved.knowledge->types().size() == 2);
  CHECK_FALSE(fs::exists(other / "moved/cell/models/notes.txt"));
  CHECK(moved.foreign_objects.size() == 1);
  CHECK(moved.board->size_m == cell.board->size_m);
}

}  // namespace vantage
