#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>
#include <string>

#include "reconstruction/knowledge_file.hpp"

#include "support/test_data.hpp"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;

const fs::path kShipped = test::assets() / "knowledge";

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) bounds.extend(vertex.cast<double>());
  return bounds;
}

}  // namespace

TEST_CASE("shipped cubes: twelve types or more, another marker on each side") {
  const FileKnowledgeBase cubes({kShipped / "cubes.yaml"});
  CHECK(cubes.types().size() >= 12);
  CHECK(cubes.files() == std::vector{kShipped / "cubes.yaml"});
  std::set<int> ids;
  for (const auto& type : cubes.types()) {
    CAPTURE(type->name);
    CHECK(type->is_a == std::vector<std::string>{"cube"});
    CHECK(bounds_of(*type->mesh).sizes().isApprox(Eigen::Vector3d::Constant(0.05), 1e-6));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::set<std::pair<int, int>> sides;
    for (const Marker& marker : type->markers()) {
      CHECK(ids.insert(marker.id).second);
      const Eigen::Vector3d at = marker.T_object_marker.translation();
      const Eigen::Vector3d out = marker.T_object_marker.rotation().col(2);
      CHECK((at - 0.025 * out).norm() < 1e-12);  // in the middle of a side, looking outwards
      int axis = 0;
      CHECK(out.cwiseAbs().maxCoeff(&axis) == doctest::Approx(1).epsilon(1e-12));
      sides.insert({axis, out[axis] > 0});
      const Eigen::Vector3d up = axis == 2 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
      CHECK((marker.T_object_marker.rotation().col(1) - up).norm() < 1e-12);
      sum += at;
    }
    CHECK(sides.size() == 6);
    CHECK(sum.norm() < 1e-12);
  }
}

TEST_CASE("all shipped knowledge bases go together") {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(kShipped)) {
    files.push_back(entry.path());
  }
  CHECK(files.size() >= 2);
  const FileKnowledgeBase all(files);
  for (const auto& type : all.types()) {
    CAPTURE(type->name);
    REQUIRE(type->mesh);
    CHECK(bounds_of(*type->mesh).center().norm() < 1e-6);  // BOP's origin
    CHECK(all.is_a(type->name, "thing"));
  }
}

TEST_CASE("a type's keys are read") {
  TemporaryFolder folder;
  const FileKnowledgeBase base = load(
      folder,
      type_text(
          "name: tin\n"
          "    is_a: [container, round thing]\n"
          "    shape: {cylinder: {radius_m: 0.03, height_m: 0.06}}\n"
          "    color: [0.1, 0.2, 1]\n"
          "    symmetries:\n"
          "      discrete:\n"
          "        - {w: 0, x: 1, y: 0, z: 0}\n"
          "        - {rotation: {w: 0, x: 0, y: 1, z: 0}, translation_m: [0, 0.01, 0]}\n"
          "      continuous: [{axis: [0, 0, 2]}, {axis: [0, 1, 0], offset_m: [1, 2, 3]}]\n"
          "    features:\n"
          "      - type: aruco\n"
          "        dictionary: 6X6_250\n"
          "        value: 33\n"
          "        size_m: 0.02\n"
          "        pose: {translation_m: [0.001, 0, -0.03], rotation: {w: 0, x: 0, y: 1, z: 0}}"));
  const ObjectType& tin = *base.get("tin", "here");
  CHECK(tin.place.ends_with("types.yaml:2: object_types[0]"));
  CHECK_FALSE(tin.bop_id);
  CHECK(tin.is_a == std::vector<std::string>{"container", "round thing"});
  CHECK(tin.color == Eigen::Vector3f(0.1f, 0.2f, 1));
  CHECK(bounds_of(*tin.mesh).sizes().isApprox(Eigen::Vector3d(0.06, 0.06, 0.06), 1e-6));
  REQUIRE(tin.symmetries.discrete.size() == 2);
  CHECK(tin.symmetries.discrete[0].rotation() ==
        Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix());
  CHECK(tin.symmetries.discrete[0].translation().norm() == 0);
  CHECK(tin.symmetries.discrete[1].rotation() ==
        Eigen::Vector3d(-1, 1, -1).asDiagonal().toDenseMatrix());
  CHECK(tin.symmetries.discrete[1].translation() == Eigen::Vector3d(0, 0.01, 0));
  REQUIRE(tin.symmetries.continuous.size() == 2);
  CHECK(tin.symmetries.continuous[0].axis == Eigen::Vector3d::UnitZ());
  CHECK(tin.symmetries.continuous[0].offset_m.norm() == 0);
  CHECK(tin.symmetries.continuous[1].offset_m == Eigen::Vector3d(1, 2, 3));
  REQUIRE(tin.markers().size() == 1);
  const Marker marker = tin.markers()[0];
  CHECK(marker.dictionary == "6X6_250");
  CHECK(marker.id == 33);
  CHECK(marker.size_m == 0.02);
  CHECK(marker.T_object_marker.translation() == Eigen::Vector3d(0.001, 0, -0.03));
  CHECK(marker.T_object_marker.rotation().col(2) == -Eigen::Vector3d::UnitZ());
  const FileKnowledgeBase plain = load(folder, type_text("{name: a, " + kCubeShape + "}"));
  CHECK(plain.types()[0]->is_a.empty());
  CHECK(plain.types()[0]->features.empty());
  CHECK(plain.types()[0]->symmetries.none());
  CHECK(plain.types()[0]->color == ObjectType().color);
}

TEST_CASE("a mesh file is read relative to the file that names it") {
  TemporaryFolder folder;
  folder.write("tri.stl",
               "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\n"
               "vertex 0 1000 0\nendloop\nendfacet\nendsolid t\n");
  const FileKnowledgeBase base =
      load(folder, type_text("{name: a, shape: {mesh: {file: tri.stl, unit_m: 0.001}}}"));
  CHECK(bounds_of(*base.types()[0]->mesh).sizes() == Eigen::Vector3d(1, 1, 0));
  CHECK(base.files() == std::vector{folder / "types.yaml", folder / "tri.stl"});
}

TEST_CASE("a type's mesh is named as a workcell's is") {
  TemporaryFolder folder;
  folder.write("tri.stl",
               "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\n"
               "vertex 0 2 0\nendloop\nendfacet\nendsolid t\n");
  for (const char* mesh :
       {"mesh: tri.stl", "shape: {mesh: tri.stl}", "mesh: {file: tri.stl, up: z}",
        "shape: {mesh: {file: tri.stl, unit_m: 1}}"}) {
    CAPTURE(mesh);
    const FileKnowledgeBase base = load(folder, type_text(fmt::format("{{name: a, {}}}", mesh)));
    CHECK(bounds_of(*base.types()[0]->mesh).sizes() == Eigen::Vector3d(4, 2, 0));
  }
  const FileKnowledgeBase standing =
      load(folder, type_text("{name: a, mesh: {file: tri.stl, unit_m: 0.5, up: y}}"));
  CHECK(bounds_of(*standing.types()[0]->mesh).sizes() == Eigen::Vector3d(2, 0, 1));
  expect_type_refused("{name: a, mesh: {file: tri.stl, up: up}}", "object_types[0].mesh.up",
                      {"\"-z\""});
  expect_type_refused("{name: a, mesh: {file: \"\"}}", "object_types[0].mesh.file", {"not empty"});
  expect_type_refused("{name: a, mesh: .}", "object_types[0].mesh", {"is a folder"});
}

TEST_CASE("an invalid type is refused") {
  expect_type_refused("{name: a}", "types.yaml:2: object_types[0]",
                      {"exactly one of the keys \"shape\", \"mesh\""});
  expect_type_refused("{" + kCubeShape + "}", "object_types[0].name", {"missing"});
  expect_type_refused("{name: a, shape: {}}", "types.yaml:2: object_types[0].shape",
                      {"exactly one of the keys \"box\", \"cylinder\""});
  expect_type_refused("{name: a, shape: {boks: {size_m: [1, 1, 1]}}}", "shape.boks", {"\"box\""});
  expect_type_refused("{name: a, shape: {box: {size_m: [1, -1, 1]}}}",
                      "object_types[0].shape.box.size_m[1]", {"found -1"});
  expect_type_refused("{name: a, " + kCubeShape + ", color: [0, 0, 2]}", "object_types[0].color[2]",
                      {"found 2"});
  expect_type_refused("{name: a, " + kCubeShape + ", colour: [0, 0, 1]}", "object_types[0].colour",
                      {"\"color\""});
  expect_type_refused("{name: a, shape: {mesh: {file: gone.stl}}}",
                      "object_types[0].shape.mesh.file", {"no file", "gone.stl"});
  expect_type_refused(
      "{name: a, " + kCubeShape + ", symmetries: {discrete: [{w: 1, x: 1, y: 0, z: 0}]}}",
      "object_types[0].symmetries.discrete[0]", {"norm"});
  expect_type_refused(
      "{name: a, " + kCubeShape + ", symmetries: {continuous: [{axis: [0, 0, 0]}]}}",
      "object_types[0].symmetries.continuous[0].axis", {"no direction"});
}

TEST_CASE("sizes that make no solid are refused where they stand") {
  expect_type_refused("{name: a, shape: {cup: {radius_m: 0.1, height_m: 0.1, wall_m: 0.2}}}",
                      "types.yaml:2: object_types[0].shape.cup.wall_m", {"0.2"});
  expect_type_refused("{name: a, shape: {bracket: {size_m: [1, 1, 1], thickness_m: 2}}}",
                      "types.yaml:2: object_types[0].shape.bracket.thickness_m", {"2"});
}

TEST_CASE("names are there once in all of the files") {
  TemporaryFolder folder;
  const std::string text = type_text("{name: a, " + kCubeShape + "}");
  const std::vector<fs::path> files{folder.write("1.yaml", text), folder.write("2.yaml", text)};
  expect_refused([&] { FileKnowledgeBase base(files); }, "2.yaml:2: object_types[0]",
                 {"\"a\"", "1.yaml:2: object_types[0]"});
}

TEST_CASE("the hierarchies of several files are merged") {
  TemporaryFolder folder;
  const std::string types = type_text("{name: a, is_a: [b], " + kCubeShape + "}");
  const fs::path first = folder.write("1.yaml", types + "hierarchy:\n  b: [c]\n  c: [d]\n");
  const auto with = [&](const std::string& hierarchy) {
    return FileKnowledgeBase(
        {first, folder.write("2.yaml", "hierarchy:\n  " + hierarchy + "\nobject_types: []\n")});
  };
  const FileKnowledgeBase base = with("b: [e]");
  for (const char* ancestor : {"a", "b", "c", "d", "e"}) {
    CAPTURE(ancestor);
    CHECK(base.is_a("a", ancestor));
    CHECK(base.types_that_are(ancestor) == base.types());
  }
  CHECK_FALSE(base.is_a("b", "a"));
  CHECK(with("f: [a]").is_a("f", "d"));  // types may be parents, too
  expect_refused([&] { with("d: [b]"); }, "1.yaml:4: hierarchy.b",
                 {"\"b is a c is a d is a b\"", "its own ancestor"});
  expect_refused([&] { with("d: [a]"); }, "1.yaml:2: object_types[0]",
                 {"\"a is a b is a c is a d is a a\""});
  expect_refused([&] { with("d: e"); }, "2.yaml:2: hierarchy.d", {"found \"e\"", "an array"});
  expect_refused([&] { with("d: []"); }, "2.yaml:2: hierarchy.d", {"found []"});
}

}  // namespace vantage::test
