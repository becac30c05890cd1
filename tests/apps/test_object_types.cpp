#include "object_types.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "documents/schemas.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;

const fs::path kShipped = fs::path(__FILE__).parent_path() / "../../assets/knowledge";
const std::string kCube = "shape: {box: {size_m: [0.05, 0.05, 0.05]}}";

/// One type from the lines of its mapping, the first of which stands in line 2.
std::string type_of(const std::string& lines) {
  return "object_types:\n  - " + lines + "\n";
}

KnowledgeBase load(const TemporaryFolder& folder, const std::string& text) {
  return KnowledgeBase({folder.write("types.yaml", text)});
}

void expect_type_refused(const std::string& lines, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(lines);
  TemporaryFolder folder;
  expect_refused([&] { load(folder, type_of(lines)); }, where, parts);
}

std::string with_marker(const std::string& marker, const std::string& shape = kCube) {
  return "{name: a, " + shape + ",\n     features: [{type: aruco, " + marker + "}]}";
}

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) bounds.extend(vertex.cast<double>());
  return bounds;
}

}  // namespace

TEST_CASE("shipped cubes: twelve types or more, another marker on each side") {
  const KnowledgeBase cubes({kShipped / "cubes.yaml"});
  CHECK(cubes.types().size() >= 12);
  CHECK(cubes.files() == std::vector{kShipped / "cubes.yaml"});
  std::set<int> ids;
  for (const auto& type : cubes.types()) {
    CAPTURE(type->name);
    CHECK(type->is_a == std::vector<std::string>{"cube"});
    CHECK(bounds_of(type->shape->mesh).sizes().isApprox(Eigen::Vector3d::Constant(0.05), 1e-6));
    CHECK(type->shape->textured());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::set<std::pair<int, int>> sides;
    for (const Marker& marker : type->markers) {
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
  const KnowledgeBase all(files);
  for (const auto& type : all.types()) {
    CAPTURE(type->name);
    REQUIRE(type->shape);
    CHECK(bounds_of(type->shape->mesh).center().norm() < 1e-6);  // BOP's origin
    CHECK(type->shape->textured() == !type->markers.empty());
  }
}

TEST_CASE("a type's keys are read") {
  TemporaryFolder folder;
  const KnowledgeBase base = load(
      folder,
      type_of(
          "name: tin\n"
          "    is_a: [container, round thing]\n"
          "    shape: {cylinder: {radius_m: 0.03, height_m: 0.06}}\n"
          "    color: [0.1, 0.2, 1]\n"
          "    symmetries:\n"
          "      discrete: [{w: 0, x: 1, y: 0, z: 0}]\n"
          "      continuous: [{axis: [0, 0, 2]}, {axis: [0, 1, 0], offset_m: [1, 2, 3]}]\n"
          "    features:\n"
          "      - type: aruco\n"
          "        dictionary: 6X6_250\n"
          "        value: 33\n"
          "        size_m: 0.02\n"
          "        pose: {translation_m: [0.001, 0, -0.03], rotation: {w: 0, x: 0, y: 1, z: 0}}"));
  const ObjectType& tin = *base.type("tin", "here");
  CHECK(tin.is_a == std::vector<std::string>{"container", "round thing"});
  CHECK(tin.shape->color == Eigen::Vector3f(0.1f, 0.2f, 1));
  CHECK(bounds_of(tin.shape->mesh).sizes().isApprox(Eigen::Vector3d(0.06, 0.06, 0.06), 1e-6));
  REQUIRE(tin.symmetries.discrete.size() == 1);
  CHECK(tin.symmetries.discrete[0].coeffs() == Eigen::Vector4d(1, 0, 0, 0));
  REQUIRE(tin.symmetries.continuous.size() == 2);
  CHECK(tin.symmetries.continuous[0].axis == Eigen::Vector3d::UnitZ());
  CHECK(tin.symmetries.continuous[0].offset_m.norm() == 0);
  CHECK(tin.symmetries.continuous[1].offset_m == Eigen::Vector3d(1, 2, 3));
  REQUIRE(tin.markers.size() == 1);
  CHECK(tin.markers[0].dictionary == "6X6_250");
  CHECK(tin.markers[0].id == 33);
  CHECK(tin.markers[0].size_m == 0.02);
  CHECK(tin.markers[0].T_object_marker.translation() == Eigen::Vector3d(0.001, 0, -0.03));
  CHECK(tin.markers[0].T_object_marker.rotation().col(2) == -Eigen::Vector3d::UnitZ());
  const KnowledgeBase plain = load(folder, type_of("{name: a, " + kCube + "}"));
  CHECK(plain.types()[0]->is_a.empty());
  CHECK(plain.types()[0]->symmetries.none());
  CHECK(!plain.types()[0]->shape->textured());
}

TEST_CASE("every shape of the schema makes its solid") {
  TemporaryFolder folder;
  folder.write("tri.stl",
               "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\n"
               "vertex 0 1000 0\nendloop\nendfacet\nendsolid t\n");
  const std::vector<std::pair<std::string, Eigen::Vector3d>> shapes{
      {"box: {size_m: [1, 2, 3]}", {1, 2, 3}},
      {"cylinder: {radius_m: 1, height_m: 3}", {2, 2, 3}},
      {"sphere: {radius_m: 1}", {2, 2, 2}},
      {"wedge: {size_m: [1, 2, 3]}", {1, 2, 3}},
      {"cup: {radius_m: 1, height_m: 3, wall_m: 0.1}", {2, 2, 3}},
      {"bracket: {size_m: [1, 2, 3], thickness_m: 0.1}", {1, 2, 3}},
      {"bin: {size_m: [1, 2, 3], wall_m: 0.1}", {1, 2, 3}},
      {"duck: {length_m: 0.1}", {0.1, 0, 0}},
      {"mesh: {file: tri.stl, unit_m: 0.001}", {1, 1, 0}}};
  CHECK(shapes.size() == knowledge_schema()["definitions"]["shape"]["properties"].size());
  for (const auto& [shape, size_m] : shapes) {
    CAPTURE(shape);
    const KnowledgeBase base = load(folder, type_of("{name: a, shape: {" + shape + "}}"));
    const Eigen::Vector3d sizes = bounds_of(base.types()[0]->shape->mesh).sizes();
    for (int axis = 0; axis < 3; ++axis) {
      if (shape.starts_with("duck") && axis > 0) continue;  // as high and wide as ducks are
      CHECK(sizes[axis] == doctest::Approx(size_m[axis]).epsilon(1e-5));
    }
    if (shape.starts_with("mesh")) {
      CHECK(base.files() == std::vector{folder / "types.yaml", folder / "tri.stl"});
    }
  }
}

TEST_CASE("workcells and knowledge bases have the same shapes and colours") {
  for (const char* name : {"shape", "size", "color", "vector"}) {
    CAPTURE(name);
    CHECK(knowledge_schema()["definitions"][name] == workcell_schema()["definitions"][name]);
  }
}

TEST_CASE("a type that is none is refused") {
  expect_type_refused("{name: a}", "types.yaml:2: object_types[0].shape", {"missing"});
  expect_type_refused("{" + kCube + "}", "object_types[0].name", {"missing"});
  expect_type_refused("{name: a, shape: {}}", "types.yaml:2: object_types[0].shape",
                      {"exactly one of the keys \"box\", \"cylinder\""});
  expect_type_refused("{name: a, shape: {boks: {size_m: [1, 1, 1]}}}", "shape.boks", {"\"box\""});
  expect_type_refused("{name: a, shape: {box: {size_m: [1, -1, 1]}}}",
                      "object_types[0].shape.box.size_m[1]", {"found -1"});
  expect_type_refused("{name: a, " + kCube + ", color: [0, 0, 2]}", "object_types[0].color[2]",
                      {"found 2"});
  expect_type_refused("{name: a, " + kCube + ", colour: [0, 0, 1]}", "object_types[0].colour",
                      {"\"color\""});
  expect_type_refused("{name: a, shape: {mesh: {file: gone.stl}}}",
                      "object_types[0].shape.mesh.file", {"no file", "gone.stl"});
  expect_type_refused(
      "{name: a, " + kCube + ", symmetries: {discrete: [{w: 1, x: 1, y: 0, z: 0}]}}",
      "object_types[0].symmetries.discrete[0]", {"norm"});
  expect_type_refused("{name: a, " + kCube + ", symmetries: {continuous: [{axis: [0, 0, 0]}]}}",
                      "object_types[0].symmetries.continuous[0].axis", {"no direction"});
}

TEST_CASE("sizes that make no solid are refused where they stand") {
  expect_type_refused("{name: a, shape: {cup: {radius_m: 0.1, height_m: 0.1, wall_m: 0.2}}}",
                      "types.yaml:2: object_types[0].shape.cup.wall_m", {"0.2"});
  expect_type_refused("{name: a, shape: {bracket: {size_m: [1, 1, 1], thickness_m: 2}}}",
                      "types.yaml:2: object_types[0].shape.bracket.thickness_m", {"2"});
}

TEST_CASE("features that are none are refused") {
  const std::string good = "dictionary: 4X4_50, value: 3, size_m: 0.04";
  expect_type_refused(with_marker(good), "types.yaml:3: object_types[0].features[0]",
                      {"exactly one of the keys \"face\", \"pose\""});
  expect_type_refused(with_marker(good + ", face: +z, pose: {}"), "features[0]", {"exactly one"});
  expect_type_refused(with_marker(good + ", face: up"), "features[0].face", {"\"+z\""});
  expect_type_refused(with_marker("dictionary: 4X4_51, value: 3, size_m: 0.04, face: +z"),
                      "types.yaml:3: object_types[0].features[0].dictionary", {"4X4_51", "4X4_50"});
  expect_type_refused(with_marker("dictionary: 4X4_50, value: 50, size_m: 0.04, face: +z"),
                      "types.yaml:3: object_types[0].features[0].value", {"50"});
  expect_type_refused(
      with_marker(good + ", face: +z", "shape: {cylinder: {radius_m: 1, height_m: 1}}"),
      "types.yaml:3: object_types[0].features[0].face", {"only a box has faces", "pose"});
  // What does not lie on a face, or beyond its edge.
  CHECK_THROWS_WITH_AS(
      load(TemporaryFolder(), type_of(with_marker(good + ", pose: {translation_m: [0, 0, 0.03]}"))),
      doctest::Contains("types.yaml:3: object_types[0].features, marker 3 of 4X4_50"), Error);
  CHECK_THROWS_WITH_AS(
      load(TemporaryFolder(),
           type_of(with_marker("dictionary: 4X4_50, value: 3, size_m: 0.06, face: +z"))),
      doctest::Contains("beyond the face's edge"), Error);
}

TEST_CASE("names and markers are there once in all of the files") {
  TemporaryFolder folder;
  const auto marked = [](const std::string& name, const std::string& marker) {
    return type_of("{name: " + name + ", " + kCube + ",\n     features: [{type: aruco, " + marker +
                   ", size_m: 0.04, face: +x}]}");
  };
  const fs::path first = folder.write("1.yaml", marked("a", "dictionary: 4X4_50, value: 3"));
  const auto with = [&](const std::string& text) {
    return KnowledgeBase({first, folder.write("2.yaml", text)});
  };
  CHECK(with(marked("b", "dictionary: 4X4_50, value: 4")).types().size() == 2);
  CHECK(with(marked("b", "dictionary: 5X5_50, value: 3")).types().size() == 2);
  expect_refused([&] { with(type_of("{name: a, " + kCube + "}")); },
                 "2.yaml:2: object_types[0].name", {"\"a\"", "1.yaml:2: object_types[0].name"});
  // The cells of 4X4_50's markers are those of 4X4_250's.
  for (const char* dictionary : {"4X4_50", "4X4_250"}) {
    expect_refused(
        [&] { with(marked("b", std::string("dictionary: ") + dictionary + ", value: 3")); },
        "2.yaml:3: object_types[0].features[0].value",
        {"marker 3", "1.yaml:3: object_types[0].features[0]"});
  }
}

TEST_CASE("a type that the knowledge base does not have is refused") {
  TemporaryFolder folder;
  const KnowledgeBase base = load(folder, "object_types:\n  - {name: red_cube, " + kCube +
                                              "}\n  - {name: duck, " + kCube + "}\n");
  CHECK(base.type("duck", "here") == base.types()[1]);
  expect_refused([&] { (void)base.type("redcube", "--types"); }, "--types",
                 {"\"redcube\"", "did you mean \"red_cube\"?"});
  expect_refused([&] { (void)base.type("x", "--types"); }, "--types",
                 {"its types are red_cube, duck"});
  expect_refused([] { (void)KnowledgeBase().type("x", "--types"); }, "--types",
                 {"no knowledge base", "knowledge_base"});
}

}  // namespace vantage::test
