// What a knowledge base in memory refuses.
#include <doctest/doctest.h>

#include "reconstruction/cube_type.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage::test {
namespace {

void expect_feature_refused(std::vector<ObjectFeature> features, const std::string& where,
                            std::initializer_list<std::string_view> parts) {
  ObjectType type = cube_type("tin");
  type.features = std::move(features);
  expect_refused([&] { MemoryKnowledgeBase({type}); }, where, parts);
}

}  // namespace

TEST_CASE("invalid types are refused") {
  expect_refused(
      [] {
        MemoryKnowledgeBase({cube_type("a"), cube_type("a")});
      },
      "a", {"\"a\"", "already used", "unique"});
  expect_refused([] { MemoryKnowledgeBase({{.name = "a"}}); }, "a", {"no mesh"});
  ObjectType nameless = cube_type("");
  nameless.place = "here";
  expect_refused([&] { MemoryKnowledgeBase({nameless}); }, "here", {"without a name"});
  ObjectType round = cube_type("a");
  round.symmetries.continuous = {{Eigen::Vector3d::UnitZ()}, {{0, 0, 2}}};
  expect_refused([&] { MemoryKnowledgeBase({round}); }, "a.symmetries.continuous[1]",
                 {"length 2", "expected 1"});
  round.symmetries.continuous = {{Eigen::Vector3d::UnitZ(), {0, kNaN, 0}}};
  expect_refused([&] { MemoryKnowledgeBase({round}); }, "a.symmetries.continuous[0]",
                 {"(0, nan, 0)", "finite"});
}

TEST_CASE("invalid features of a type are rejected") {
  const FeatureKey key{"keypoint", "spout"};
  expect_feature_refused({cube_marker(1), {key, FeaturePoints{}}}, "tin.features[1]",
                         {"no points"});
  expect_feature_refused({{key, FeaturePoints{{{0, 0, 0}, {kNaN, 0, 0}}}}}, "tin.features[0]",
                         {"point 1", "nan"});
  expect_feature_refused({{key, FeatureLabel{{{0, kNaN, 0}}, 0.1}}}, "tin.features[0]",
                         {"point 0", "nan"});
  expect_feature_refused({{key, FeatureLabel{{{0, 0, 0}}, -0.1}}}, "tin.features[0]",
                         {"radius", "-0.1"});
  expect_feature_refused({{{"keypoint", ""}, FeaturePose{}}}, "tin.features[0]",
                         {"\"keypoint\", \"\"", "a type and a value"});
  expect_feature_refused({marker_feature({"4X4_50", 1, 0, {}})}, "tin.features[0]",
                         {"size is 0 m", "above 0"});
}

TEST_CASE("two features that are the same in everything are refused, others with one key are not") {
  const FeatureKey key{"keypoint", "screw"};
  const Pose there = Pose::from_translation({0, 0, 0.1});
  const std::vector<std::pair<ObjectFeature, ObjectFeature>> pairs{
      {cube_marker(1), cube_marker(1, {0, 0, 0.1})},
      {cube_marker(1), marker_feature({"4X4_50", 1, 0.02, Pose::from_translation({0, 0, 0.025})})},
      {{key, FeaturePoints{{{0, 0, 0}}}}, {key, FeaturePoints{{{0, 0, 1}}}}},
      {{key, FeaturePose{}}, {key, FeaturePose{there}}},
      {{key, FeatureLabel{}}, {key, FeatureLabel{{{0, 0, 0}}, 0.1}}},
      {{key, FeatureLabel{{{0, 0, 0}}, 0.2}}, {key, FeatureLabel{{{0, 0, 0}}, 0.1}}},
      {{key, FeaturePose{}}, {key, FeatureLabel{}}}};
  for (const auto& [one, other] : pairs) {
    ObjectType type = cube_type("a");
    type.features = {one, other};
    CHECK_NOTHROW(MemoryKnowledgeBase({type}));
    expect_feature_refused({one, other, one}, "tin.features[2]", {"repeats features[0]"});
    expect_feature_refused({one, other, other}, "tin.features[2]", {"repeats features[1]"});
  }
  expect_feature_refused(
      {cube_marker(1), marker_feature({"4X4_250", 1, 0.03, Pose::from_translation({0, 0, 0.025})})},
      "tin.features[1]", {"aruco 4X4/1 repeats features[0]"});
}

}  // namespace vantage::test
