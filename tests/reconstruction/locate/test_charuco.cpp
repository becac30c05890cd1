// Real photographs: three of one printed board, whose upper half is the world, and whose lower half
// an object with the identity as its true pose. What is left is the paper: seen from all three
// cameras alike, its upper corners and its left edge stand off by a few millimetres, and its halves
// are bent against each other by a quarter of a degree. See assets/workcells/charuco.yaml.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "support/scene_count.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/calibration.hpp"
#include "vantage/reconstruction/color_image.hpp"
#include "vantage/reconstruction/detector.hpp"
#include "vantage/reconstruction/locate_camera.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

const std::filesystem::path kAssets = test::assets();

/// Where the printed pattern has its markers; independent of the assets. OpenCV's order until 4.5:
/// row by row from above, in the second square of the first row.
std::vector<Marker> printed_markers() {
  std::vector<Marker> markers;
  for (int row = 0; row < 7; ++row) {
    for (int column = 1 - row % 2; column < 5; column += 2) {
      const Eigen::Vector3d at(0.04 * (column - 2), 0.04 * (3 - row), 0);
      markers.push_back({"6X6_250", int(markers.size()), 0.02, Pose::from_translation(at)});
    }
  }
  return markers;
}

std::vector<ObjectFeature> board() {
  std::vector<ObjectFeature> features;
  for (const Marker& marker : printed_markers()) {
    if (marker.id <= 8) features.push_back(marker_feature(marker));
  }
  return features;
}

struct LocatedView {
  CameraView view;
  double rms_px;
};

/// All three photographs, with the cameras located by the markers 0 to 8.
std::vector<LocatedView> located_views(const std::filesystem::path& folder) {
  std::vector<LocatedView> views;
  const Lens lens = read_calibration(folder / "camera.yml");
  const ArucoDetector detector({{"6X6_250"}, lens});
  for (const char* name : {"view_0.jpg", "view_1.jpg", "view_2_occluded.jpg"}) {
    CAPTURE(name);
    CameraView view{name, lens};
    view.observations = detector.detect(read_color(folder / name));
    const CameraLocation location = locate_camera(lens, view.observations, board());
    CAPTURE(location.reason);
    REQUIRE(location.pose);
    view.T_world_cam = location.pose->T_world_cam;
    view.covariance = location.pose->covariance;
    CHECK(location.outliers.empty());
    views.push_back({std::move(view), location.pose->rms_px});
  }
  return views;
}

struct BoardError {
  double mm = 0;  ///< in the middle of the object's markers
  double degrees = 0;
};

/// Of the one object that there has to be.
BoardError error_of(const Reconstruction& found) {
  REQUIRE(found.objects.size() == 1);
  const Pose& pose = found.objects[0].T_world_object;
  const Eigen::Vector3d middle(0, -0.05, 0);
  return {1e3 * (pose * middle - middle).norm(),
          Eigen::AngleAxisd(pose.rotation()).angle() * 180 / std::numbers::pi};
}

}  // namespace

TEST_CASE("the printed board: every marker that is in the photographs is found") {
  const auto folder = recording("charuco");
  if (!folder) return;
  const ArucoDetector detector({{"6X6_250"}, {}});
  CHECK(detector.detect(read_color(*folder / "view_0.jpg")).size() == 17);
  CHECK(detector.detect(read_color(*folder / "view_1.jpg")).size() == 17);
  CHECK(detector.detect(read_color(*folder / "view_2_occluded.jpg")).size() == 13);
}

TEST_CASE("the printed board: cameras are located to half a pixel") {
  const auto folder = recording("charuco");
  if (!folder) return;
  for (const LocatedView& located : located_views(*folder)) {
    CAPTURE(located.view.name);
    MESSAGE(located.view.name << ": " << located.rms_px << " px");
    CHECK(located.rms_px < 0.57);
  }
}

TEST_CASE("the printed board: multi-view PnP and SVD find its lower half where it is" *
          doctest::skip(kSanitized)) {
  const auto folder = recording("charuco");
  if (!folder) return;
  const FileKnowledgeBase knowledge({kAssets / "knowledge/charuco_object.yaml"});
  std::vector<CameraView> views;
  for (LocatedView& located : located_views(*folder)) views.push_back(std::move(located.view));

  const BoardError pnp = error_of(reconstruct_pnp(views, knowledge));
  const BoardError svd = error_of(reconstruct_svd(views, knowledge));
  MESSAGE("PnP: " << pnp.mm << " mm, " << pnp.degrees << " degrees");
  MESSAGE("SVD: " << svd.mm << " mm, " << svd.degrees << " degrees");
  CHECK(pnp.mm < 0.63);
  CHECK(pnp.degrees < 0.62);
  CHECK(pnp.mm < svd.mm);
  CHECK(svd.mm < 2);
  CHECK(svd.degrees < 1.1);
  for (const CameraView& view : views) {
    const BoardError alone = error_of(reconstruct_svd({&view, 1}, knowledge));
    MESSAGE("SVD, " << view.name << ": " << alone.mm << " mm, " << alone.degrees << " degrees");
    CHECK(alone.mm < 2.5);
    CHECK(alone.degrees < 1.35);
  }
}

TEST_CASE("the printed board: assets have it as it is printed") {
  const FileKnowledgeBase knowledge({kAssets / "knowledge/charuco_object.yaml"});
  REQUIRE(knowledge.types().size() == 1);
  const std::vector<Marker> lower = knowledge.types()[0]->markers();
  const std::vector<Marker> printed = printed_markers();
  REQUIRE(printed.size() == 17);
  REQUIRE(lower.size() == 8);
  for (const Marker& marker : lower) {
    CAPTURE(marker.id);
    CHECK(marker.dictionary == "6X6_250");
    for (std::size_t c = 0; c < 4; ++c) {
      CHECK((marker.corners()[c] - printed.at(std::size_t(marker.id)).corners()[c]).norm() < 1e-12);
    }
  }
}
