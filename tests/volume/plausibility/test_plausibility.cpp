#include "vantage/volume/plausibility.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/random_scene.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

using test::Random;
using test::scene_count;

const Box kWorkArea({-0.3, -0.3, 0}, {0.3, 0.3, 0.3});
constexpr double kVoxel_m = 0.01;
constexpr Intrinsics kImage{160, 120, 150, 150, 79.5, 59.5};

/// Boxes on a floor that two or three cameras measure.
struct Cell {
  WorldModel world;

  explicit Cell(std::uint32_t seed) {
    Random random(seed);
    SceneBuilder truth;
    truth.add_box(Box({-3, -3, -0.1}, {3, 3, 0}));
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d half(random.uniform(0.02, 0.06), random.uniform(0.02, 0.06), 0.05);
      const Eigen::Vector3d at(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.05);
      truth.add_box(Box(at - half, at + half));
    }
    const auto scene = truth.build();
    const int cameras = 2 + int(random.below(2));
    for (int i = 0; i < cameras; ++i) {
      const double turn = random.uniform(0, 2 * EIGEN_PI), distance = random.uniform(0.8, 1.4);
      const Eigen::Vector3d eye(distance * std::cos(turn), distance * std::sin(turn),
                                random.uniform(0.7, 1.2));
      const PinholeCamera camera(kImage, Pose::looking_at(eye, {0, 0, 0.05}));
      world.cameras.push_back(
          {std::to_string(i), camera, std::make_shared<DepthImage>(scene->render_depth(camera))});
    }
  }

  std::vector<std::string> findings() const { return implausibilities(world, kWorkArea, kVoxel_m); }

  /// The first finding; all of them have to be about the same.
  std::string finding() const {
    const auto all = findings();
    return all.empty() ? std::string("nothing") : all.front();
  }

  template <typename Change>
  void change_poses(const Change& change) {
    for (DepthCamera& camera : world.cameras) {
      camera.camera = camera.camera.moved_to(change(camera.camera.T_world_cam()));
    }
  }

  template <typename Change>
  void change_depths(const Change& change) {
    for (DepthCamera& camera : world.cameras) {
      std::vector<float> metres(camera.depth->metres().begin(), camera.depth->metres().end());
      for (float& depth : metres) depth = float(change(double(depth)));
      camera.depth = std::make_shared<DepthImage>(camera.depth->width(), camera.depth->height(),
                                                  std::move(metres));
    }
  }
};

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

KnownObject box_at(const std::string& name, const Eigen::Vector3d& size,
                   const Eigen::Vector3d& at) {
  return {name, std::make_shared<TriangleMesh>(box_solid(size)), Pose::from_translation(at)};
}

}  // namespace

TEST_CASE("what fits together is not warned of") {
  for (std::uint32_t seed = 0; seed < scene_count(40); ++seed) {
    CAPTURE(seed);
    Cell cell(seed);
    cell.world.objects.push_back(box_at("part", {0.08, 0.08, 0.08}, {0.1, 0, 0.04}));
    cell.world.static_structures.push_back(box_at("floor", {4, 4, 0.1}, {0, 0, -0.05}));
    const auto findings = cell.findings();
    CAPTURE(findings.empty() ? "" : findings.front());
    CHECK(findings.empty());
  }
}

TEST_CASE("poses the wrong way round, with other axes or in another unit are named") {
  for (std::uint32_t seed = 0; seed < scene_count(15); ++seed) {
    CAPTURE(seed);
    const auto turned = [](const Pose& pose) {
      Eigen::Matrix3d rotation = pose.rotation();
      rotation.rightCols<2>() *= -1;
      return Pose::from_rotation(rotation, pose.translation());
    };
    const auto scaled = [](const Pose& pose, double factor) {
      return Pose::from_rotation(pose.rotation(), factor * pose.translation());
    };
    Cell inverted(seed), opengl(seed), both(seed), metres(seed), large(seed);
    inverted.change_poses([](const Pose& pose) { return pose.inverse(); });
    CAPTURE(inverted.finding());
    CHECK(says(inverted.finding(), "camera-to-world poses were given where world-to-camera"));
    opengl.change_poses(turned);
    CHECK(says(opengl.finding(), "OpenGL's axes"));
    both.change_poses([&](const Pose& pose) { return turned(pose).inverse(); });
    CHECK(says(both.finding(), "camera-to-world poses with OpenGL's axes"));
    metres.change_poses([&](const Pose& pose) { return scaled(pose, 0.001); });
    CHECK(says(metres.finding(), "translations are in metres"));
    large.change_poses([&](const Pose& pose) { return scaled(pose, 1000); });
    CHECK(says(large.finding(), "1000 times too large"));
  }
}

TEST_CASE("a work area beyond a camera's depth range is named") {
  for (std::uint32_t seed = 0; seed < scene_count(15); ++seed) {
    CAPTURE(seed);
    Cell cell(seed);
    DepthCamera& last = cell.world.cameras.back();
    const PinholeCamera& camera = last.camera;
    last.camera = PinholeCamera(camera.intrinsics(), camera.T_world_cam(), {0.1, 0.3});
    last.depth = nullptr;
    const std::string found = cell.finding();
    CAPTURE(found);
    CHECK(says(found, ("image " + last.name + ": the work area lies").c_str()));
    CHECK(says(found, "its depth range is 0.1 to 0.3 m"));
  }
}

TEST_CASE("depth in another scale, in whole metres, or without readings is named") {
  for (std::uint32_t seed = 0; seed < scene_count(15); ++seed) {
    CAPTURE(seed);
    for (const double factor : {1000.0, 0.001, 10.0, 0.1}) {
      CAPTURE(factor);
      Cell cell(seed);
      cell.change_depths([&](double depth) { return factor * depth; });
      CHECK(says(cell.finding(), "depth_scale"));
    }
    Cell metres(seed), counts(seed), empty(seed);
    metres.change_depths([](double depth) { return std::max(1.0, std::round(depth)); });
    bool named = false;
    for (const std::string& finding : metres.findings()) {
      named = named || says(finding, "rounded to whole metres");
    }
    CHECK(named);
    counts.change_depths([](double depth) { return 0.001 * std::max(1.0, std::round(depth)); });
    CHECK(says(counts.finding(), "1000 times larger"));
    empty.change_depths([](double) { return 0.0; });
    CHECK(says(empty.finding(), "no valid reading"));
  }
}

TEST_CASE("a camera that the others contradict is named") {
  for (std::uint32_t seed = 0; seed < scene_count(15); ++seed) {
    CAPTURE(seed);
    Cell cell(seed);
    PinholeCamera& camera = cell.world.cameras[0].camera;
    const Pose& pose = camera.T_world_cam();
    // Lifted, it measures a floor that hangs in the air, which the others see through.
    camera = camera.moved_to(Pose::from_translation({0, 0, 0.25}) * pose);
    const std::string finding = cell.finding();
    CAPTURE(finding);
    CHECK(says(finding, "contradict each other"));
    CHECK(says(finding, cell.world.cameras.size() == 2 ? "images 0 and 1" : "image 0"));
  }
}

TEST_CASE("intrinsics of another resolution are named, those of a cropped image are not") {
  CHECK(resolution_misfit(kImage).empty());
  Intrinsics twice = kImage;
  twice.fx *= 2, twice.fy *= 2, twice.cx *= 2, twice.cy *= 2;
  CHECK(says(resolution_misfit(twice), "multiply fx, fy, cx and cy by 0.5"));
  Intrinsics half = kImage;
  half.fx /= 2, half.fy /= 2, half.cx /= 2, half.cy /= 2;
  CHECK(says(resolution_misfit(half), "multiply fx, fy, cx and cy by 2"));
  Intrinsics turned = kImage;
  std::swap(turned.cx, turned.cy);
  CHECK(says(resolution_misfit(turned), "rotated by 90 degrees"));
  CHECK(resolution_misfit({130, 160, 150, 150, -10.5, 59.5}).empty());
  CHECK(resolution_misfit({640, 480, 600, 600, 330.1, 228.4}).empty());
}

TEST_CASE("cameras inside solids and objects of another unit are named") {
  Cell cell(1);
  cell.world.static_structures.push_back(
      box_at("housing", {0.1, 0.1, 0.1}, cell.world.cameras[1].camera.centre()));
  CHECK(says(cell.finding(), "image 1: the camera stands inside housing"));
  cell.world.static_structures = {box_at("pole", {0.1, 0.1, 0.1}, {1.5, 1.5, 0.5})};
  CHECK(cell.findings().empty());

  cell.world.objects = {box_at("tiny", {0.004, 0.004, 0.002}, {0, 0, 0.1})};
  CHECK(says(cell.finding(), "tiny: it is 0.004 m large, less than a voxel"));
  cell.world.objects = {box_at("huge", {120, 1, 1}, {0, 0, 0.1})};
  CHECK(says(cell.finding(), "huge: it is 120 m large"));
  cell.world.objects = {box_at("away", {0.1, 0.1, 0.1}, {100, 0, 0})};
  CHECK(says(cell.finding(), "in millimetres"));
  cell.world.objects.clear();
  bool named = false;
  for (const auto& finding :
       implausibilities(cell.world, Box({-300, -300, 0}, {300, 300, 300}), 10)) {
    named = named || says(finding, "are these millimetres?");
  }
  CHECK(named);
}

}  // namespace vantage
