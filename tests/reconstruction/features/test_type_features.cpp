// The features of knowledge base files.
#include <doctest/doctest.h>

#include <string>

#include "reconstruction/knowledge_file.hpp"

namespace vantage::test {

namespace fs = std::filesystem;

TEST_CASE("invalid features in a file are rejected") {
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
}

TEST_CASE("features of other detectors: points, a pose, a label near points or anywhere") {
  TemporaryFolder folder;
  const FileKnowledgeBase base = load(
      folder, type_text("name: mug\n    " + kCubeShape +
                        "\n    features:\n"
                        "      - {type: keypoint, value: rim, points_m: [[1, 2, 3], [4, 5, 6]]}\n"
                        "      - {type: pose, value: mug, pose: {translation_m: [0, 0, 0.1]}}\n"
                        "      - {type: color, value: red, near_m: [[0, 0, 0.1]], radius_m: 0.02}\n"
                        "      - {type: class, value: \"7\", anywhere: true}"));
  const std::vector<ObjectFeature>& features = base.types()[0]->features;
  REQUIRE(features.size() == 4);
  CHECK(features[0].key == FeatureKey{"keypoint", "rim"});
  CHECK((features[0].points() == std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}}));
  CHECK(features[1].key == FeatureKey{"pose", "mug"});
  CHECK(std::get<FeaturePose>(features[1].geometry).T_object_feature.translation() ==
        Eigen::Vector3d(0, 0, 0.1));
  CHECK(features[2].key == FeatureKey{"color", "red"});
  const auto& near = std::get<FeatureLabel>(features[2].geometry);
  CHECK(near.points_m == std::vector<Eigen::Vector3d>{{0, 0, 0.1}});
  CHECK(near.radius_m == 0.02);
  CHECK(features[3].key == FeatureKey{"class", "7"});
  CHECK(std::get<FeatureLabel>(features[3].geometry).points_m.empty());
  CHECK(base.with_feature({"color", "red"}).size() == 1);
}

TEST_CASE("invalid features of other detectors are refused") {
  const auto expect = [](const std::string& keys, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
    expect_type_refused(with_feature(keys), where, parts);
  };
  const std::string at = "types.yaml:3: object_types[0].features[0]",
                    key = "type: color, value: red";
  const std::string choices =
      "exactly one of the keys \"points_m\", \"pose\", \"near_m\" with \"radius_m\", \"anywhere\"";
  expect("value: red, anywhere: true", at + ".type", {"missing"});
  expect("type: color, anywhere: true", at + ".value", {"missing"});
  expect("type: color, value: 3, anywhere: true", at + ".value", {"found 3", "a string"});
  expect(key, at, {choices});
  expect(key + ", anywhere: true, pose: {}", at, {choices});
  expect(key + ", near_m: [[0, 0, 0]]", at, {choices});
  expect(key + ", radius_m: 1, anywhere: true", at, {choices});
  expect(key + ", anywhere: false", at + ".anywhere", {"found false", "true"});
  expect(key + ", point_m: [[0, 0, 0]]", at + ".point_m", {"did you mean \"points_m\""});
  expect(key + ", points_m: []", at + ".points_m", {"1 or more"});
  expect(key + ", points_m: [[0, 0]]", at + ".points_m[0]", {"3 numbers"});
  expect(key + ", near_m: [[0, 0, 0]], radius_m: 0", at + ".radius_m", {"found 0"});
  expect(key + ", size_m: 1, anywhere: true", at + ".size_m", {"unknown key"});
  expect_type_refused("{name: a, " + kCubeShape + ",\n     features: [7]}", at,
                      {"found 7", "an object"});
  expect(key + ", anywhere: true}, {" + key + ", anywhere: true",
         "types.yaml:2: object_types[0].features[1]", {"color red", "repeats features[0]"});
}

TEST_CASE("one marker may be on several types, but under one dictionary's name") {
  TemporaryFolder folder;
  const auto marked = [](const std::string& name, const std::string& marker) {
    return type_text("{name: " + name + ", " + kCubeShape + ",\n     features: [{type: aruco, " +
                     marker + ", size_m: 0.04, face: +x}]}");
  };
  const fs::path first = folder.write("1.yaml", marked("a", "dictionary: 4X4_50, value: 3"));
  const auto with = [&](const std::string& text) {
    return FileKnowledgeBase({first, folder.write("2.yaml", text)});
  };
  const FileKnowledgeBase shared = with(marked("b", "dictionary: 4X4_50, value: 3"));
  CHECK(shared.with_feature(marker_key("4X4_50", 3)).size() == 2);
  CHECK_NOTHROW(with(marked("b", "dictionary: 4X4_250, value: 4")));
  CHECK_NOTHROW(with(marked("b", "dictionary: 5X5_50, value: 3")));
  expect_refused([&] { with(marked("b", "dictionary: 4X4_250, value: 3")); },
                 "2.yaml:3: object_types[0].features[0].dictionary",
                 {"marker 3 of 4X4_250 is marker 3 of 4X4_50",
                  "1.yaml:3: object_types[0].features[0].dictionary", "one dictionary name"});
}

}  // namespace vantage::test
