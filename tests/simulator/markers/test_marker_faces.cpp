#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>
#include <vector>

#include "simulator/marked_box.hpp"
#include "simulator/texture_lookup.hpp"
#include "support/expect_error.hpp"

using namespace vantage;
using namespace vantage::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST_CASE("a face may be round, and its triangles long and thin") {
  const TriangleMesh cylinder = cylinder_solid(0.03, 0.02);
  const auto on_top = [](double size_m) {
    return Marker{"4X4_50", 9, size_m, Pose::from_translation({0.001, 0, 0.01})};
  };
  const Marker fits = on_top(0.041), large = on_top(0.043);
  const TexturedMesh shape = with_markers(cylinder, kOrange, {&fits, 1}, "test");
  const auto top = facing(cylinder, {0, 0, 1});
  CHECK(top.size() == 48);
  CHECK(color_at(shape, top, {0.001, 0.0204, 0.01}) == std::array{15, 15, 15});
  CHECK(color_at(shape, top, {0.001, 0.0206, 0.01}) == std::array{235, 235, 235});
  expect_refused(
      [&] {
        with_markers(cylinder, kOrange, {&large, 1}, "test");
      },
      "4X4_50", {"beyond the face's edge"});
}

TEST_CASE("a curved wall takes no marker wider than its facets, and a hole none at all") {
  Matrix3d outwards;
  outwards << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // z along x
  const double facet = 0.03 * std::cos(std::numbers::pi / 48);
  const Matrix3d turn =
      Eigen::AngleAxisd(std::numbers::pi / 48, Vector3d::UnitZ()).toRotationMatrix();
  const Pose pose = Pose::from_rotation(turn * outwards, turn * Vector3d(facet, 0, 0));
  const Marker narrow{"4X4_50", 1, 0.003, pose}, wide{"4X4_50", 1, 0.006, pose};
  with_markers(cylinder_solid(0.03, 0.02), kOrange, {&narrow, 1}, "test");
  expect_refused(
      [&] {
        with_markers(cylinder_solid(0.03, 0.02), kOrange, {&wide, 1}, "test");
      },
      "4X4_50", {"beyond the face's edge"});

  // Stands on both plates of the bracket's side, with a corner over the gap between them.
  const Vector3d size(0.08, 0.05, 0.08);
  const Marker over{"4X4_50", 1, 0.03, face_pose(size, 3, 0, {-0.024, -0.024, 0})};
  const Marker beside{"4X4_50", 1, 0.029, face_pose(size, 3, 0, {-0.025, -0.025, 0})};
  with_markers(bracket_solid(size, 0.03), kOrange, {&beside, 1}, "test");
  expect_refused(
      [&] {
        with_markers(bracket_solid(size, 0.03), kOrange, {&over, 1}, "test");
      },
      "4X4_50", {"beyond the face's edge"});
}

TEST_CASE("markers that are not on a face are refused") {
  const Vector3d size(0.05, 0.05, 0.05);
  const auto print = [&](const Pose& pose, double size_m = 0.03) {
    const Marker marker{"4X4_50", 5, size_m, pose};
    with_markers(box_solid(size), kOrange, {&marker, 1}, "cell.yaml:3: markers");
  };
  const auto refused = [&](const Pose& pose, double size_m,
                           std::initializer_list<std::string_view> parts) {
    expect_refused([&] { print(pose, size_m); }, "cell.yaml:3: markers, marker 5 of 4X4_50", parts);
  };
  print(face_pose(size, 4, 0, {0, 0, 0.00009}));
  refused(face_pose(size, 4, 0, {0, 0, 0.00011}), 0.03, {"0.11 mm from the nearest face"});
  refused(face_pose(size, 4, 0, {0.0252, 0, 0}), 0.03, {"0.2 mm from the nearest face"});

  const auto tilted = [&](double angle) {
    const Pose straight = face_pose(size, 4, 0);
    const Matrix3d tilt = Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
    return Pose::from_rotation(straight.rotation() * tilt, straight.translation());
  };
  print(tilted(0.0099));
  refused(tilted(0.0101), 0.03, {"z axis is 0.579 degrees off"});
  refused(tilted(std::numbers::pi), 0.03, {"z axis is 180 degrees off"});

  print(face_pose(size, 4, 0, {0.01, 0.01, 0}));
  refused(face_pose(size, 4, 0, {0.0102, 0, 0}), 0.03, {"beyond the face's edge"});
  refused(face_pose(size, 4, std::numbers::pi / 4), 0.04, {"beyond the face's edge"});
  for (const double bad : {0.0, -0.01, double(NAN)}) {
    refused(face_pose(size, 4, 0), bad, {"size_m is", "above 0"});
  }
}

TEST_CASE("other markers that cannot be printed are refused") {
  const Vector3d size(0.05, 0.05, 0.05);
  const auto print = [&](const std::vector<Marker>& markers, const Eigen::Vector3f& color = kOrange,
                         double texel_m = kTexel) {
    with_markers(box_solid(size), color, markers, "here", texel_m);
  };
  const Marker good{"4X4_50", 5, 0.02, face_pose(size, 2, 0, {-0.01, 0, 0})};
  const Marker beside{"4X4_50", 6, 0.02, face_pose(size, 2, 0, {0.01, 0, 0})};
  const Marker across{"4X4_50", 7, 0.02, face_pose(size, 2, 0.7)};
  print({good, beside});
  expect_refused(
      [&] {
        print({good, across});
      },
      "here, marker 7 of 4X4_50", {"lies on here, marker 5 of 4X4_50"});
  expect_refused(
      [&] {
        print({{"4X4_50", 50, 0.02, good.T_object_marker}});
      },
      "here, marker 50 of 4X4_50", {"no id 50", "0 to 49"});
  expect_refused(
      [&] {
        print({{"4x4", 5, 0.02, good.T_object_marker}});
      },
      "here, marker 5 of 4x4", {"no marker dictionary '4x4'", "4X4_50"});
  for (const float bad : {-0.1f, 1.1f, NAN}) {
    expect_refused([&] { print({good}, {0, bad, 0}); }, "here", {"the colour is", "0 to 1"});
  }
  for (const double bad : {0.0, -1.0, double(INFINITY)}) {
    expect_refused([&] { print({good}, kOrange, bad); }, "here", {"texel_m is"});
  }
  expect_refused([&] { print({good}, kOrange, 1e-6); }, "here, marker 5 of 4X4_50",
                 {"texels of 1e-06 m", "16384", "larger"});
  std::vector<Marker> everywhere;
  for (int face = 0; face < 6; ++face) {
    everywhere.push_back({"4X4_50", face, 0.02, face_pose(size, face, 0)});
  }
  expect_refused([&] { print(everywhere, kOrange, 5e-6); }, "here", {"more than 134217728 texels"});
}
