#include "workcell/object_appearance.hpp"

#include <doctest/doctest.h>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

/// A cube with a marker, in a file.
FileKnowledgeBase cube(const std::string& marker) {
  const TemporaryFolder folder;
  return FileKnowledgeBase(
      {folder.write("types.yaml",
                    "object_types:\n"
                    "  - name: cube\n"
                    "    shape: {box: {size_m: [0.05, 0.05, 0.05]}}\n"
                    "    color: [1, 0, 0]\n"
                    "    features: [{type: color, value: red, anywhere: true},\n"
                    "      {type: aruco, dictionary: 4X4_50, value: 3, " +
                        marker + "}]\n")});
}

}  // namespace

TEST_CASE("markers are printed once for each type") {
  const FileKnowledgeBase base = cube("size_m: 0.04, face: +z");
  ObjectLooks looks;
  const auto look = looks.of(base.types()[0]);
  CHECK(look->textured());
  CHECK(look->color == Eigen::Vector3f(1, 0, 0));
  CHECK(look->mesh.vertices() == base.types()[0]->mesh->vertices());
  CHECK(looks.of(PlacedObject{"a", base.types()[0]->mesh, {}, base.types()[0]}) == look);
  // 160 texels along the marker's edge, 200 along the face's.
  CHECK(look->texture.height >= 200);
  CHECK(look->texture.height < 260);
}

TEST_CASE("an object without a type is its mesh in its colour") {
  const FileKnowledgeBase base = cube("size_m: 0.04, face: +z");
  const PlacedObject plain{"a", base.types()[0]->mesh, {}, nullptr, {0, 0, 1}};
  const auto look = ObjectLooks().of(plain);
  CHECK_FALSE(look->textured());
  CHECK(look->color == Eigen::Vector3f(0, 0, 1));
  CHECK(look->mesh.triangles() == plain.mesh->triangles());
}

TEST_CASE("a marker that does not lie on a face is refused where its type stands") {
  const std::string where = "types.yaml:2: object_types[0], marker 3 of 4X4_50";
  const FileKnowledgeBase above = cube("size_m: 0.04, pose: {translation_m: [0, 0, 0.03]}");
  expect_refused([&] { ObjectLooks().of(above.types()[0]); }, where, {"from the nearest face"});
  const FileKnowledgeBase large = cube("size_m: 0.04, pose: {translation_m: [0.01, 0, 0.025]}");
  expect_refused([&] { ObjectLooks().of(large.types()[0]); }, where, {"beyond the face's edge"});
}

}  // namespace vantage::test
