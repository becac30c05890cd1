#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "vantage/planner/advanced/view_validity_checker.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::test {
namespace {

constexpr DepthRange kCellRange{0.05, 3};

KnownObject box_object(const std::string& name, const Box& box) {
  return {name, std::make_shared<const TriangleMesh>(TriangleMesh::from_box(box)), {}};
}

/// A cube of 10 cm that stands in a work area of 40 × 40 × 20 cm, seen by one camera from above; a
/// wall outside it.
struct Cell {
  WorldModel world;
  std::shared_ptr<const StateGrid> grid;

  explicit Cell(bool with_camera = true) {
    world.objects.push_back(box_object("cube", Box({-0.05, -0.05, 0}, {0.05, 0.05, 0.1})));
    world.static_structures.push_back(box_object("wall", Box({0.9, -1, 0}, {1.1, 1, 1})));
    if (with_camera) {
      world.cameras.push_back({"above",
                               PinholeCamera({200, 200, 100, 100, 99.5, 99.5},
                                             Pose::looking_at({0, 0, 0.6}, {0, 0, 0}), {0.1, 2}),
                               nullptr});
    }
    grid = classify(world, GridGeometry::covering(Box({-0.2, -0.2, 0}, {0.2, 0.2, 0.2}), 0.01));
  }

  InvalidReason check(const ViewConstraints& limits, const Eigen::Vector3d& eye,
                      const Eigen::Vector3d& target = {0, 0, 0.0501}) const {
    const ViewValidityChecker validity(limits, PlanningScene(world, grid, OccluderMode::mesh),
                                       kCellRange);
    return validity.check(Pose::looking_at(eye, target));
  }
};

ReachMap two_cells() {
  return {{0, 0, 0}, 0.5, {1, 1, 2}, {0, 1}};
}

const ViewConstraints kBare = ViewConstraints::bare();

ViewConstraints with_body(const CameraBody& body, double clearance_m = 0) {
  return {.clearance_m = clearance_m, .body = body};
}

/// No body, but a clearance.
ViewConstraints with_clearance(double clearance_m) {
  return with_body({}, clearance_m);
}

}  // namespace

TEST_CASE("without limits a view is in the open, above the floor") {
  const Cell cell;
  CHECK(cell.check(kBare, {0.5, 0, 0.2}) == InvalidReason::none);
  CHECK(cell.check(kBare, {0.5, 0, 1e-9}) == InvalidReason::none);
  CHECK(cell.check(kBare, {0.5, 0, 0}) == InvalidReason::below_the_floor);
  CHECK(cell.check({}, {0.5, 0, -0.1}) == InvalidReason::below_the_floor);
}

TEST_CASE("the floor is a setting: elsewhere, or none") {
  const Cell cell;
  ViewConstraints limits{.clearance_m = 0.02, .body = SphereBody{0.03}, .floor_z_m = -0.7};
  CHECK(cell.check(limits, {0.5, 0, -0.1}) == InvalidReason::none);
  CHECK(cell.check(limits, {0.5, 0, -0.649}) == InvalidReason::none);
  CHECK(cell.check(limits, {0.5, 0, -0.651}) == InvalidReason::too_close_to_occupied);
  CHECK(cell.check(limits, {0.5, 0, -0.7}) == InvalidReason::below_the_floor);
  limits.floor_z_m = 0.3;
  CHECK(cell.check(limits, {0.5, 0, 0.2}) == InvalidReason::below_the_floor);
  CHECK(cell.check(limits, {0.5, 0, 0.34}) == InvalidReason::too_close_to_occupied);
  limits.floor_z_m.reset();
  CHECK(cell.check(limits, {0.5, 0, -2.5}) == InvalidReason::none);
  limits.floor_z_m = NAN;
  test::expect_bad_input("floor", "nan", [&] { limits.check(); });
}

TEST_CASE("a view is where the robot reaches: shell, box and map at once") {
  const Cell cell;
  const ViewConstraints shell{.reach = Reach{{0, 0, 0}, 0.3, 0.8}};
  CHECK(cell.check(shell, {0.5, 0, 0.2}) == InvalidReason::none);
  CHECK(cell.check(shell, {0.79, 0, 0.2}) == InvalidReason::out_of_reach);
  CHECK(cell.check(shell, {0.2, 0, 0.2}) == InvalidReason::out_of_reach);
  const ViewConstraints box{.reach_box = Box({-1, -1, 0.1}, {0.6, 0.6, 1})};
  CHECK(cell.check(box, {0.5, 0, 0.2}) == InvalidReason::none);
  CHECK(cell.check(box, {0.7, 0, 0.2}) == InvalidReason::out_of_reach);
  CHECK(cell.check(box, {0.5, 0, 0.05}) == InvalidReason::out_of_reach);
  const ViewConstraints map{.reach_map = std::make_shared<const ReachMap>(two_cells())};
  CHECK(cell.check(map, {0.4, 0.1, 0.6}) == InvalidReason::none);
  CHECK(cell.check(map, {0.4, 0.1, 0.4}) == InvalidReason::out_of_reach);
  CHECK(cell.check(map, {0.6, 0.1, 0.6}) == InvalidReason::out_of_reach);
  CHECK(cell.check(map, {-0.1, 0.1, 0.6}) == InvalidReason::out_of_reach);
  ViewConstraints all = map;
  all.reach = Reach{{0, 0, 0}, 0, 0.7};
  CHECK(cell.check(all, {0.1, 0.1, 0.6}) == InvalidReason::none);
  CHECK(cell.check(all, {0.4, 0.1, 0.6}) == InvalidReason::out_of_reach);
}

TEST_CASE("a reach map's cells are numbered with k fastest") {
  ReachMap map{{-1, 2, 0}, 0.25, {2, 3, 4}, std::vector<std::uint8_t>(24)};
  for (std::size_t cell = 0; cell < 24; ++cell) {
    map.reachable.assign(24, 0);
    map.reachable[cell] = 7;
    for (std::size_t other = 0; other < 24; ++other) {
      const Eigen::Vector3d index(double(other / 12), double(other / 4 % 3), double(other % 4));
      const Eigen::Vector3d middle = index + Eigen::Vector3d::Constant(0.5);
      CHECK(map.contains(map.origin_m + 0.25 * middle) == (cell == other));
    }
  }
  CHECK_FALSE(map.contains({std::nan(""), 2.1, 0.1}));
  CHECK_FALSE(map.contains({kInfinity, 2.1, 0.1}));
}

TEST_CASE("a view looks along the cone") {
  const Cell cell;
  ViewConstraints limits{.view_cone = ViewCone{{0, 0, -3}, 0.25 * std::numbers::pi}};
  CHECK(cell.check(limits, {0.3, 0, 0.5}) == InvalidReason::none);
  CHECK(cell.check(limits, {0.6, 0, 0.5}) == InvalidReason::outside_the_view_cone);
  CHECK(cell.check(limits, {0.45, 0, 0.5}, {0, 0, 0.05}) ==
        InvalidReason::none);                           // along its border
  limits.view_cone->half_angle_rad = std::numbers::pi;  // everywhere, even up
  CHECK(cell.check(limits, {0.5, 0, 0.2}, {0.5, 0, 1}) == InvalidReason::none);
}

TEST_CASE("a camera is in nothing occupied, in the work area or beyond, and in no shadow") {
  const Cell cell;
  CHECK(cell.check({}, {0.03, 0.02, 0.03}) == InvalidReason::inside_occupied_volume);
  CHECK(cell.check({}, {1, 0.3, 0.5}) == InvalidReason::inside_occupied_volume);  // in the wall
  CHECK(cell.check({}, {1.2, 0.3, 0.5}) == InvalidReason::none);
  const Cell dark(false);  // nobody looks: all that is not the cube is shadow
  CHECK(dark.check({}, {0.15, 0.1, 0.1}) == InvalidReason::inside_shadow);
  CHECK(dark.check({}, {0.03, 0.02, 0.03}) == InvalidReason::inside_occupied_volume);
}

TEST_CASE("what is nearer than the near depth would not be measured") {
  const Cell dark(false);
  CHECK(dark.check({}, {0.24, 0, 0.1}) == InvalidReason::too_close_to_shadow);  // 4 cm from it
  CHECK(dark.check({}, {0.26, 0, 0.1}) == InvalidReason::none);
  CHECK(dark.check({}, {0.235, 0.235, 0.1}) == InvalidReason::too_close_to_shadow);
  CHECK(dark.check({}, {0.236, 0.236, 0.1}) == InvalidReason::none);  // beside an edge
}

TEST_CASE("the camera's body keeps its distance") {
  const Cell cell;
  const Eigen::Vector3d eye(0.7, 0, 0.5);  // 20 cm before the wall, which is at its back
  CHECK(cell.check(with_clearance(0.19), eye) == InvalidReason::none);
  CHECK(cell.check(with_clearance(0.21), eye) == InvalidReason::too_close_to_occupied);
  CHECK(cell.check(with_body(SphereBody{0.09}, 0.1), eye) == InvalidReason::none);
  CHECK(cell.check(with_body(SphereBody{0.11}, 0.1), eye) == InvalidReason::too_close_to_occupied);
  const Eigen::Vector3d level(0, 0, 0.5);  // the axes of the camera are the world's
  const auto with_length = [](double length_m, double clearance_m) {
    return with_body(BoxBody{Box({-0.02, -0.02, -length_m}, {0.02, 0.02, 0})}, clearance_m);
  };
  CHECK(cell.check(with_length(0.15, 0.04), eye, level) == InvalidReason::none);
  CHECK(cell.check(with_length(0.15, 0.06), eye, level) == InvalidReason::too_close_to_occupied);
  CHECK(cell.check(with_length(0.19, 0), eye, level) == InvalidReason::none);
  CHECK(cell.check(with_length(0.21, 0), eye, level) == InvalidReason::too_close_to_occupied);
  CHECK(cell.check(with_length(0.21, 0), eye, {1, 0, 0.5}) == InvalidReason::none);  // turned round
  // A box beside the camera that is inside the wall as a whole touches no face of it.
  const BoxBody beside{Box({-0.02, -0.02, -0.32}, {0.02, 0.02, -0.28})};
  CHECK(cell.check(with_body(beside), eye, level) == InvalidReason::too_close_to_occupied);
}

TEST_CASE("the camera's body keeps its distance from the floor, which is not a structure") {
  const Cell cell;
  const Eigen::Vector3d eye(0.5, 0, 0.1), level(0, 0, 0.1);
  CHECK(cell.check(with_clearance(0.099), eye) == InvalidReason::none);
  CHECK(cell.check(with_clearance(0.101), eye) == InvalidReason::too_close_to_occupied);
  CHECK(cell.check(with_body(SphereBody{0.099}), eye) == InvalidReason::none);
  CHECK(cell.check(with_body(SphereBody{0.101}), eye) == InvalidReason::too_close_to_occupied);
  CHECK(cell.check(with_body(SphereBody{0.051}, 0.05), eye) ==
        InvalidReason::too_close_to_occupied);
  // The camera's y axis points down, and its z axis to where it looks.
  const auto box = [](const Box& body) { return with_body(BoxBody{body}); };
  const ViewConstraints short_one = box(Box({-0.2, -0.2, -0.1}, {0.2, 0.099, 0}));
  CHECK(cell.check(short_one, eye, level) == InvalidReason::none);
  CHECK(cell.check(box(Box({-0.2, -0.2, -0.1}, {0.2, 0.101, 0})), eye, level) ==
        InvalidReason::too_close_to_occupied);
  // As it looks upwards, its back sinks.
  CHECK(cell.check(short_one, eye, {0, 0, 0.5}) == InvalidReason::too_close_to_occupied);
}

TEST_CASE("by default a camera is a D435 that stays 20 mm away") {
  const Cell cell;
  const auto at = [&](double height_m) {
    return cell.check({}, {0.5, 0, height_m}, {0, 0, height_m});
  };
  CHECK(at(0.0324) == InvalidReason::too_close_to_occupied);  // half of 25 mm, and 20 mm
  CHECK(at(0.0326) == InvalidReason::none);
  CHECK(cell.check(kBare, {0.5, 0, 0.0324}, {0, 0, 0.0324}) == InvalidReason::none);
  const Box body = d435_body().box;
  CHECK((body.size() - Eigen::Vector3d(0.09, 0.025, 0.025)).norm() < 1e-12);
  CHECK(body.contains(Eigen::Vector3d::Zero()));
}

TEST_CASE("the camera's body stays out of unseen volume") {
  const Cell dark(false);
  const Eigen::Vector3d eye(0.26, 0, 0.12), level(0, 0, 0.12);  // 6 cm from it
  CHECK(dark.check(with_body(SphereBody{0.059}), eye) == InvalidReason::none);
  CHECK(dark.check(with_body(SphereBody{0.061}), eye) == InvalidReason::body_in_unseen);
  const auto with_nose = [&](double length_m) {
    return with_body(BoxBody{Box({-0.01, -0.01, -0.01}, {0.01, 0.01, length_m})});
  };
  CHECK(dark.check(with_nose(0.059), eye, level) == InvalidReason::none);
  CHECK(dark.check(with_nose(0.061), eye, level) == InvalidReason::body_in_unseen);
  CHECK(dark.check(with_nose(0.061), eye, {1, 0, 0.12}) == InvalidReason::none);  // turned round
  // Its corner reaches in, but its centre is as far away as before.
  const BoxBody wide{Box({-0.01, -0.01, -0.01}, {0.05, 0.01, 0.04})};
  CHECK(dark.check(with_body(wide), eye, level) == InvalidReason::none);
  CHECK(dark.check(with_body(wide), eye, {0, -0.26, 0.12}) == InvalidReason::body_in_unseen);
  // A box before the camera that is inside as a whole touches no face.
  const BoxBody before{Box({-0.02, -0.02, 0.11}, {0.02, 0.02, 0.15})};
  CHECK(dark.check(with_body(before), eye, level) == InvalidReason::body_in_unseen);
  const Cell seen;
  CHECK(seen.check(with_body(before), eye, level) == InvalidReason::none);
}

TEST_CASE("unseen volume needs no clearance, and beyond the work area there is none") {
  const Cell dark(false);
  const auto voxel = dark.grid->geometry().voxel_at({0.15, 0.1, 0.1});
  REQUIRE(voxel);
  CHECK(dark.grid->shadow_cause(*voxel) == ShadowCause::outside);  // which is unseen, too
  CHECK(dark.check(with_body(SphereBody{0.055}, 0.02), {0.26, 0, 0.12}) == InvalidReason::none);
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(0, 0.01, 0.4), {0.3, 0.3, 0.2}, {0, -0.28, 0.1}}) {
    CHECK(dark.check({}, eye) == InvalidReason::none);
  }
}

TEST_CASE("of several reasons the first one counts") {
  const Cell dark(false);
  ViewConstraints limits{
      .reach = Reach{{0, 0, 0}, 5, 6}, .view_cone = ViewCone{{0, 0, 1}, 0.1}, .clearance_m = 1};
  const Eigen::Vector3d in_cube(0.03, 0.02, 0.03), in_shadow(0.15, 0.1, 0.1), near(0.24, 0, 0.1);
  CHECK(dark.check(limits, {0.03, 0.02, -0.1}) == InvalidReason::below_the_floor);
  CHECK(dark.check(limits, in_cube) == InvalidReason::out_of_reach);
  limits.reach.reset();
  CHECK(dark.check(limits, in_cube) == InvalidReason::outside_the_view_cone);
  limits.view_cone.reset();
  CHECK(dark.check(limits, in_cube) == InvalidReason::inside_occupied_volume);
  CHECK(dark.check(limits, in_shadow) == InvalidReason::inside_shadow);
  CHECK(dark.check(limits, near) == InvalidReason::too_close_to_shadow);
  limits.body = SphereBody{0.07};
  CHECK(dark.check(limits, {0.26, 0, 0.1}) == InvalidReason::body_in_unseen);
  CHECK(dark.check(limits, {0.5, 0, 0.1}) == InvalidReason::too_close_to_occupied);
}

TEST_CASE("checks are called last, in order, and the first rejection counts") {
  const ViewCheck yes = [](const Pose&) { return std::nullopt; };
  const auto no = [](const std::string& why) {
    return view_check([](const Pose&) { return false; }, why);
  };
  ViewConstraints limits;
  limits.checks = {yes, no("the first"), no("the second")};
  const Cell cell;
  const auto examined = [&](const Pose& pose) {
    const PlanningScene scene(cell.world, cell.grid, OccluderMode::mesh);
    return ViewValidityChecker(limits, scene, kCellRange).examine(pose);
  };
  const Pose above = Pose::from_translation({0, 0, 2}), below = Pose::from_translation({0, 0, -1});
  CHECK(examined(above).reason == InvalidReason::rejected_by_check);
  CHECK(examined(above).check_says == "the first");
  CHECK(examined(below).reason == InvalidReason::below_the_floor);
  CHECK(examined(below).check_says.empty());
  limits.checks = {yes};
  CHECK(examined(above).valid());
}

TEST_CASE("every rejection has words of its own") {
  std::set<std::string_view> words;
  for (int reason = 0; reason <= int(InvalidReason::rejected_by_check); ++reason) {
    CHECK(words.insert(to_text(InvalidReason(reason))).second);
  }
  CHECK(to_text(InvalidReason::below_the_floor) == "below the floor");
}

TEST_CASE("limits that make no sense are refused with their values") {
  const Cell cell;
  const auto refuses = [&](const ViewConstraints& limits, std::string_view where,
                           std::string_view message) {
    expect_bad_input(where, message, [&] { limits.check(); });
    expect_bad_input(where, message, [&] { cell.check(limits, {0.5, 0, 0.2}); });
  };
  const auto with_map = [](const ReachMap& map) {
    return ViewConstraints{.reach_map = std::make_shared<const ReachMap>(map)};
  };
  refuses({.reach = Reach{{0, 0, 0}, 0.9, 0.5}}, "reach", "from 0.9 to 0.5");
  refuses({.reach = Reach{{0, 0, 0}, -1, 0.5}}, "reach", "from -1");
  refuses({.reach = Reach{{0, kInfinity, 0}, 0, 0.5}}, "reach", "[0, inf, 0]");
  refuses({.view_cone = ViewCone{{0, 0, 0}, 1}}, "view cone", "[0, 0, 0]");
  refuses({.view_cone = ViewCone{{0, 0, kInfinity}, 1}}, "view cone", "[0, 0, inf]");
  refuses({.view_cone = ViewCone{{0, 0, 1}, 0}}, "view cone", "0 rad");
  refuses({.view_cone = ViewCone{{0, 0, 1}, 3.2}}, "view cone", "3.2 rad");
  refuses({.clearance_m = -0.1}, "clearance", "-0.1 m");
  refuses({.clearance_m = kInfinity}, "clearance", "inf m");
  refuses({.body = SphereBody{std::nan("")}}, "radius of the camera's body", "nan m");
  ReachMap map = two_cells();
  map.size = {2, 1, 2};
  refuses(with_map(map), "reach map", "2 values for 2 x 1 x 2 cells");
  map.size = {-1, -1, 2};
  refuses(with_map(map), "reach map", "-1 x -1 x 2");
  map = two_cells();
  map.cell_m = 0;
  refuses(with_map(map), "reach map", "cells of 0 m");
  map = two_cells();
  map.origin_m.x() = std::nan("");
  refuses(with_map(map), "reach map", "[nan, 0, 0]");
}

}  // namespace vantage::test
