// What the schemas promise, and what they have in common.
#include "documents/schemas.hpp"

#include <doctest/doctest.h>

#include <string>

#include "support/test_data.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage::test {
namespace {

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) bounds.extend(vertex.cast<double>());
  return bounds;
}

}  // namespace

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
  for (const auto& entry : shapes) {
    const auto& shape = entry.first;
    const auto& size_m = entry.second;
    CAPTURE(shape);
    const FileKnowledgeBase base(
        {folder.write("types.yaml", "object_types: [{name: a, shape: {" + shape + "}}]\n")});
    const Eigen::Vector3d sizes = bounds_of(*base.types()[0]->mesh).sizes();
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

}  // namespace vantage::test
