#include <doctest/doctest.h>

#include "reconstruction/cube_type.hpp"
#include "support/expect_error.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage::test {
namespace {

std::vector<std::string> names(const std::vector<TypePtr>& types) {
  std::vector<std::string> all;
  for (const TypePtr& type : types) all.push_back(type->name);
  return all;
}

/// Another store: it knows a single type and reads no file.
class OneDuck final : public KnowledgeBase {
 public:
  const std::vector<TypePtr>& types() const override { return types_; }
  TypePtr find(std::string_view name) const override {
    return name == "duck" ? types_.front() : nullptr;
  }
  bool is_a(std::string_view name, std::string_view ancestor) const override {
    return name == ancestor || (name == "duck" && ancestor == "bird");
  }
  const std::vector<TypeFeature>& with_feature(const FeatureKey& key) const override {
    return key == FeatureKey{"color", "yellow"} ? yellow_ : none_;
  }

 private:
  std::vector<TypePtr> types_{std::make_shared<const ObjectType>(cube_type("duck"))};
  std::vector<TypeFeature> yellow_{{types_.front(), 0}}, none_;
};

}  // namespace

TEST_CASE("a marker's key is its family and id, its points are its corners") {
  CHECK(marker_key("4X4_50", 17) == FeatureKey{"aruco", "4X4/17"});
  CHECK(marker_key("4X4_250", 17) == marker_key("4X4_50", 17));
  CHECK(marker_key("ARUCO_ORIGINAL", 3) == FeatureKey{"aruco", "ARUCO_ORIGINAL/3"});
  const ObjectFeature feature = cube_marker(7, {1, 2, 3});
  CHECK(feature.key == marker_key("4X4_50", 7));
  CHECK((feature.points() ==
         std::vector<Eigen::Vector3d>{
             {0.985, 2.015, 3}, {1.015, 2.015, 3}, {1.015, 1.985, 3}, {0.985, 1.985, 3}}));
  const FeatureKey key{"keypoint", "spout"};
  CHECK(ObjectFeature{key, FeaturePoints{{{1, 2, 3}}}}.points().at(0) == Eigen::Vector3d(1, 2, 3));
  CHECK(ObjectFeature{key, FeaturePose{}}.points().empty());
  CHECK(ObjectFeature{key, FeatureLabel{{{1, 2, 3}}, 0.1}}.points().empty());
}

TEST_CASE("a type's markers are those of its features, in their order") {
  ObjectType type = cube_type("cube");
  type.features = {cube_marker(3), {{"color", "red"}, FeatureLabel{}}, cube_marker(1)};
  const std::vector<Marker> markers = type.markers();
  REQUIRE(markers.size() == 2);
  CHECK(markers[0].id == 3);
  CHECK(markers[1].id == 1);
}

TEST_CASE("types are found by name and by feature, in the order in which they were given") {
  ObjectType a = cube_type("a"), b = cube_type("b");
  a.features = {cube_marker(1), cube_marker(2, {0, 0, 0.1})};
  b.features = {{{"color", "red"}, FeatureLabel{}}, cube_marker(2)};
  const MemoryKnowledgeBase base({b, a});
  CHECK(names(base.types()) == std::vector<std::string>{"b", "a"});
  CHECK(base.find("a") == base.types()[1]);
  CHECK(base.find("c") == nullptr);
  const auto& shared = base.with_feature(marker_key("4X4_100", 2));  // on both types
  REQUIRE(shared.size() == 2);
  CHECK(shared[0].type == base.types()[0]);
  CHECK(shared[0].index == 1);
  CHECK(shared[1].type == base.types()[1]);
  CHECK(shared[1].index == 1);
  CHECK(base.with_feature({"color", "red"}).size() == 1);
  CHECK(base.with_feature({"color", "blue"}).empty());
  CHECK(MemoryKnowledgeBase().types().empty());
}

TEST_CASE("one marker may be on a type several times") {
  ObjectType type = cube_type("cube");
  type.features = {cube_marker(1), cube_marker(1, {0, 0, -0.025})};
  CHECK(MemoryKnowledgeBase({type}).with_feature(marker_key("4X4_50", 1)).size() == 2);
}

TEST_CASE("ancestors are found through types and through names that are not types") {
  const MemoryKnowledgeBase base({cube_type("red_cube", {"cube"}), cube_type("mug", {"container"}),
                                  cube_type("big_red_cube", {"red_cube", "container"})},
                                 {{"cube", {"block", "toy"}}, {"block", {"thing"}}});
  CHECK(base.is_a("red_cube", "red_cube"));
  CHECK(base.is_a("red_cube", "cube"));
  CHECK(base.is_a("big_red_cube", "thing"));
  CHECK(base.is_a("cube", "toy"));
  CHECK(base.is_a("nobody", "nobody"));
  CHECK_FALSE(base.is_a("cube", "red_cube"));
  CHECK_FALSE(base.is_a("mug", "thing"));
  CHECK_FALSE(base.is_a("nobody", "thing"));
  CHECK(names(base.types_that_are("cube")) == std::vector<std::string>{"red_cube", "big_red_cube"});
  CHECK(names(base.types_that_are("container")) == std::vector<std::string>{"mug", "big_red_cube"});
  CHECK(names(base.types_that_are("mug")) == std::vector<std::string>{"mug"});
  CHECK(base.types_that_are("nobody").empty());
}

TEST_CASE("two paths to one ancestor are not a cycle, and neither is a long path") {
  const MemoryKnowledgeBase diamond({cube_type("a", {"b", "c"})}, {{"b", {"d"}}, {"c", {"d"}}});
  CHECK(diamond.is_a("a", "d"));
  Hierarchy chain;
  for (int i = 0; i < 20000; ++i) chain[std::to_string(i)] = {std::to_string(i + 1)};
  CHECK(MemoryKnowledgeBase({}, chain).is_a("0", "20000"));
  Hierarchy lattice;  // 2^60 ways up
  for (int i = 0; i < 60; ++i) {
    const std::string up = std::to_string(i + 1);
    lattice["a" + std::to_string(i)] = lattice["b" + std::to_string(i)] = {"a" + up, "b" + up};
  }
  const MemoryKnowledgeBase many({}, lattice);
  CHECK(many.is_a("a0", "b60"));
  CHECK_FALSE(many.is_a("a0", "c"));
}

TEST_CASE("nothing is its own ancestor") {
  expect_refused([] { MemoryKnowledgeBase({cube_type("a", {"a"})}); }, "a",
                 {"\"a is a a\"", "its own ancestor"});
  ObjectType placed = cube_type("a", {"b"});
  placed.place = "types.yaml:2: object_types[0]";
  const Hierarchy back{{"b", {"x", "c"}}, {"c", {"a"}}, {"0", {"a"}}};
  expect_refused([&] { MemoryKnowledgeBase({placed}, back); }, "types.yaml:2: object_types[0]",
                 {"\"a is a b is a c is a a\""});
  expect_refused(
      [] {
        MemoryKnowledgeBase({}, {{"b", {"c"}}, {"c", {"b"}}});
      },
      "hierarchy: b", {"\"b is a c is a b\""});
}

TEST_CASE("a type that the knowledge base does not have is refused with the nearest") {
  const MemoryKnowledgeBase base({cube_type("red_cube"), cube_type("duck")});
  CHECK(base.get("duck", "here") == base.types()[1]);
  expect_refused([&] { (void)base.get("redcube", "--types"); }, "--types",
                 {"\"redcube\"", "did you mean \"red_cube\"?"});
  expect_refused([&] { (void)base.get("x", "--types"); }, "--types",
                 {"its types are red_cube, duck"});
  expect_refused([] { (void)MemoryKnowledgeBase().get("x", "--types"); }, "--types",
                 {"no knowledge base", "knowledge_base"});
}

TEST_CASE("another store can be put behind the interface") {
  const OneDuck store;
  const KnowledgeBase& base = store;
  CHECK(base.get("duck", "here") == base.types()[0]);
  CHECK(names(base.types_that_are("bird")) == std::vector<std::string>{"duck"});
  CHECK(base.types_that_are("fish").empty());
  CHECK(base.with_feature({"color", "yellow"}).size() == 1);
  expect_refused([&] { (void)base.get("dukc", "here"); }, "here", {"did you mean \"duck\"?"});
}

}  // namespace vantage::test
