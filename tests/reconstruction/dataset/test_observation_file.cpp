// Files of observations that other detectors write.

#include <doctest/doctest.h>

#include <string>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/observation_file.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

const std::string kMarker = R"({"image": 3, "type": "aruco", "dictionary": "4X4_50", "value": 7,)"
                            R"( "corners_px": [[1, 2], [11, 2.5], [11, 12], [1, 12]]})";

void expect_line_refused(const std::string& line, std::string_view where_end,
                         std::string_view message) {
  CAPTURE(line);
  const TemporaryFolder folder;
  const auto file = folder.write("seen.jsonl", kMarker + "\n\n" + line + "\n");
  expect_refused([&] { read_observations(file); }, where_end, {message});
}

}  // namespace

TEST_CASE("all kinds of observations are read, image by image in their order") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "seen.jsonl",
      kMarker + "\r\n\n" +
          R"({"image": 0, "type": "keypoint", "value": "spout", "points_px": [[310.2, 200.5]], "sigma_px": 1})" +
          "\n" +
          R"({"image": 3, "type": "pose", "value": "obj_000001", "sigma_rad": 0.1, "T_cam_feature":)" +
          R"( {"rotation": {"w": 0, "x": 1, "y": 0, "z": 0}, "translation_m": [0.1, 0, 0.8]}})" +
          "\n" +
          R"({"image": 3, "type": "color", "value": "red", "point_m": [0.1, 0, 0.8], "sigma_m": 0.01})");
  const auto seen = read_observations(file);
  REQUIRE(seen.size() == 2);
  REQUIRE(seen.at(0).size() == 1);
  REQUIRE(seen.at(3).size() == 3);
  const auto& spout = std::get<SeenPoints>(seen.at(0)[0].data);
  CHECK(seen.at(0)[0].key == FeatureKey{"keypoint", "spout"});
  CHECK(spout.pixels == std::vector<Eigen::Vector2d>{{310.2, 200.5}});
  CHECK(spout.sigma_px == 1);
  CHECK(seen.at(3)[0].key == marker_key("4X4_50", 7));
  const auto& corners = std::get<SeenPoints>(seen.at(3)[0].data);
  CHECK(corners.pixels == std::vector<Eigen::Vector2d>{{1, 2}, {11, 2.5}, {11, 12}, {1, 12}});
  CHECK(corners.sigma_px == SeenPoints{}.sigma_px);
  const auto& pose = std::get<SeenPose>(seen.at(3)[1].data);
  CHECK(pose.T_cam_feature.rotation().isApprox(
      Eigen::Matrix3d(Eigen::Vector3d(1, -1, -1).asDiagonal())));
  CHECK(pose.T_cam_feature.translation() == Eigen::Vector3d(0.1, 0, 0.8));
  CHECK(pose.sigma_m == SeenPose{}.sigma_m);
  CHECK(pose.sigma_rad == 0.1);
  const auto& label = std::get<SeenLabel>(seen.at(3)[2].data);
  CHECK(label.p_cam_m == Eigen::Vector3d(0.1, 0, 0.8));
  CHECK(label.sigma_m == 0.01);
}

TEST_CASE("invalid numbers are read, and reported later") {
  const TemporaryFolder folder;
  for (const char* none : {"null", "\"NaN\"", "\"Infinity\"", "\"-Infinity\""}) {
    CAPTURE(none);
    const auto seen = read_observations(folder.write(
        "seen.jsonl",
        std::string(R"({"image": 0, "type": "a", "value": "b", "points_px": [[0, 1], [2, )") +
            none + "]]}\n" + R"({"image": 0, "type": "a", "value": "b", "point_m": [0, 0, 1],)" +
            R"("sigma_m": )" + none + "}\n"));
    CHECK(fault_of(seen.at(0)[0]) == "point 1 is not finite");
    CHECK(fault_of(seen.at(0)[1]).find("sigma_m is nan") == 0);
  }
}

TEST_CASE("a file without lines is of a detector that saw nothing") {
  const TemporaryFolder folder;
  CHECK(read_observations(folder.write("seen.jsonl", "")).empty());
  CHECK(read_observations(folder.write("seen.jsonl", "\n \r\n\n")).empty());
}

TEST_CASE("lines that are not as the schema has them are refused with their place") {
  const std::string start = R"({"image": 0, "type": "a", "value": "b")";
  expect_line_refused("{", "seen.jsonl:3:2", "invalid or truncated JSON");
  expect_line_refused("[1]", "seen.jsonl:3", "found [1]; expected");
  expect_line_refused(start + "}", "seen.jsonl:3", "exactly one of the keys");
  expect_line_refused(start + R"(, "point_m": [0, 0, 1], "points_px": [[1, 2]]})", "seen.jsonl:3",
                      "exactly one of the keys");
  expect_line_refused(start + R"(, "point_mm": [0, 0, 1]})", "seen.jsonl:3: point_mm",
                      "\"point_m\"");
  expect_line_refused(start + R"(, "point_m": [0, 1]})", "seen.jsonl:3: point_m", "array of 3");
  expect_line_refused(start + R"(, "point_m": [0, 1, "much"]})", "seen.jsonl:3: point_m[2]",
                      "much");
  expect_line_refused(start + R"(, "points_px": []})", "seen.jsonl:3: points_px", "1 to 4096");
  expect_line_refused(start + R"(, "a": 1, "a": 2})", R"(seen.jsonl:3:51)", "twice");
  expect_line_refused(R"({"image": -1, "type": "a", "value": "b", "point_m": [0, 0, 1]})",
                      "seen.jsonl:3: image", ">= 0");
  expect_line_refused(R"({"type": "a", "value": "b", "point_m": [0, 0, 1]})", "seen.jsonl:3: image",
                      "missing");
  expect_line_refused(start +
                          R"(, "T_cam_feature": {"rotation": {"w": 2, "x": 0, "y": 0, "z": 0},)" +
                          R"( "translation_m": [0, 0, 1]}})",
                      "seen.jsonl:3: T_cam_feature.rotation", "norm");
  expect_line_refused(std::string(100, '['), "seen.jsonl:3:65", "nested");
}

TEST_CASE("what does not fit together in a line is refused") {
  const std::string corners = R"("corners_px": [[1, 2], [11, 2], [11, 12], [1, 12]]})";
  const std::string aruco = R"({"image": 0, "type": "aruco", )";
  expect_line_refused(aruco + R"("value": 1, )" + corners, "seen.jsonl:3", "\"dictionary\"");
  expect_line_refused(aruco + R"("dictionary": "4X4_50", "value": "1", )" + corners,
                      "seen.jsonl:3: value", "whole number");
  expect_line_refused(aruco + R"("dictionary": "4X4_50", "value": 50, )" + corners,
                      "seen.jsonl:3: value", "no id 50");
  expect_line_refused(aruco + R"("dictionary": "4X4_50", "value": 4294967296, )" + corners,
                      "seen.jsonl:3: value", "4294967296");
  expect_line_refused(aruco + R"("dictionary": "4X4", "value": 1, )" + corners,
                      "seen.jsonl:3: dictionary", "'4X4'");
  expect_line_refused(aruco + R"("dictionary": "4X4_50", "value": 1, "point_m": [0, 0, 1]})",
                      "seen.jsonl:3", "\"corners_px\"");
  expect_line_refused(R"({"image": 0, "type": "a", "value": "b", )" + corners,
                      "seen.jsonl:3: corners_px", "remove it");
  expect_line_refused(R"({"image": 0, "type": "a", "value": 1, "point_m": [0, 0, 1]})",
                      "seen.jsonl:3: value", "as a string");
  expect_line_refused(
      R"({"image": 0, "type": "a", "value": "b", "sigma_px": 1, "point_m": [0, 0, 1]})",
      "seen.jsonl:3: sigma_px", "remove it");
}

TEST_CASE("a file that is missing is named") {
  expect_bad_input("nowhere.jsonl", "", [] { read_observations("nowhere.jsonl"); });
}
