#include "plan/candidate_options.hpp"

#include <doctest/doctest.h>

#include "plan/report/candidate_json.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

const Box kArea({-0.3, -0.4, 0}, {0.3, 0.4, 0.2});

Workcell cell_with(const CandidateSet& candidates) {
  return {.work_area = kArea, .candidates = candidates};
}

/// What a command line makes of a workcell.
Workcell after(const std::string& arguments, Workcell cell) {
  CLI::App app;
  CandidateOptions options;
  options.add_to(app);
  app.parse(arguments);
  options.apply(cell);
  return cell;
}

HalfSpheres spheres_after(const std::string& arguments, const CandidateSet& candidates) {
  const Workcell cell = after(arguments, cell_with(candidates));
  REQUIRE(std::holds_alternative<HalfSpheres>(cell.candidates));
  return std::get<HalfSpheres>(cell.candidates);
}

}  // namespace

TEST_CASE("without options the workcell's candidates and limits stay") {
  Workcell cell = cell_with(HalfSpheres{{0.5}, {7}, {1, 0.2}});
  cell.constraints.clearance_m = 0.04;
  const Workcell same = after("", cell);
  const HalfSpheres& spheres = std::get<HalfSpheres>(same.candidates);
  CHECK(spheres.radii_m == std::vector{0.5});
  CHECK(spheres.counts == std::vector{7});
  CHECK(spheres.fan.rings == 1);
  CHECK(same.constraints.clearance_m == 0.04);
  CHECK(after("--clearance 0", cell).constraints.clearance_m == 0);
  CHECK(after("--clearance 0.1", cell).constraints.clearance_m == 0.1);
}

TEST_CASE("the camera's body by name wins over the workcell's, and without either it is a D435's") {
  Workcell cell = cell_with(production_views());
  const auto box_after = [&](const char* arguments) {
    return std::get<BoxBody>(after(arguments, cell).constraints.body).box;
  };
  CHECK(box_after("").min() == d435_body().box.min());
  CHECK(after("", cell).constraints.clearance_m == 0.02);
  const ViewConstraints none = after("--camera-body none", cell).constraints;
  CHECK(std::holds_alternative<std::monostate>(none.body));
  CHECK(none.clearance_m == 0.02);  // an option of its own
  cell.constraints.body = SphereBody{0.1};
  CHECK(std::holds_alternative<SphereBody>(after("", cell).constraints.body));
  CHECK(box_after("--camera-body d435").max() == d435_body().box.max());
}

TEST_CASE("a named set wins, at the workcell's radii unless others are given") {
  const HalfSpheres own{{0.5, 0.6}, {60}};
  const HalfSpheres production = spheres_after("--candidates production", own);
  CHECK(production.counts == std::vector{20});
  CHECK(production.radii_m == own.radii_m);
  const HalfSpheres full = spheres_after("--candidates full", own);
  CHECK(full.counts == std::vector{684, 685});
  CHECK(full.fan.rings == 2);
  CHECK(full.radii_m == own.radii_m);
  const HalfSpheres at_one = spheres_after("--candidates full --radii 0.8", own);
  CHECK(at_one.counts == std::vector{1369});
  CHECK(at_one.radii_m == std::vector{0.8});
  CHECK(spheres_after("--candidates full", ViewList{{Pose()}}).counts ==
        std::vector{456, 456, 457});
}

TEST_CASE("single numbers go before the set's") {
  const HalfSpheres spheres =
      spheres_after("--radii 0.4,0.5 --count 5,9 --rings 3 --ring-step 0.1", production_views());
  CHECK(spheres.radii_m == std::vector{0.4, 0.5});
  CHECK(spheres.counts == std::vector{5, 9});
  CHECK(spheres.fan.rings == 3);
  CHECK(spheres.fan.step_rad == 0.1);
  CHECK(spheres_after("--candidates full --rings 0", production_views()).fan.rings == 0);
  CHECK(spheres_after("--candidates full --count 50", production_views()).counts ==
        std::vector{50});
  const Workcell grid = after("--rings 2", cell_with(BoxGrid{kArea, {2, 2, 2}}));
  CHECK(std::get<BoxGrid>(grid.candidates).fan.rings == 2);
}

TEST_CASE("a file of views is read, and one of the inputs") {
  TemporaryFolder folder;
  const auto file = folder.write("v.yaml", "views: [{eye_m: [1, 0, 1], target_m: [0, 0, 0]}]\n");
  const Workcell cell = after("--candidates " + file.string(), cell_with(production_views()));
  REQUIRE(std::holds_alternative<ViewList>(cell.candidates));
  CHECK(std::get<ViewList>(cell.candidates).poses.size() == 1);
  CHECK(cell.files == std::vector{file});
  expect_bad_input("productoin", "o such file",
                   [&] { after("--candidates productoin", cell_with(production_views())); });
}

TEST_CASE("options that do not go with the candidates are refused") {
  const auto refuses = [](const char* arguments, const CandidateSet& set, const char* where) {
    CAPTURE(arguments);
    expect_bad_input(where, "--candidates production", [&] { after(arguments, cell_with(set)); });
  };
  const ViewList list{{Pose()}};
  refuses("--radii 0.5", list, "--radii");
  refuses("--count 5", list, "--count");
  refuses("--rings 1", list, "--rings");
  refuses("--ring-step 0.1", list, "--ring-step");
  refuses("--rings 1", AroundPath{{Pose()}}, "--rings");
  refuses("--radii 0.5", BoxGrid{kArea}, "--radii");
  for (const char* arguments :
       {"--radii -1", "--radii 0", "--count 0", "--rings 51", "--ring-step 0", "--ring-step 4",
        "--clearance -1", "--camera-body d436"}) {
    CAPTURE(arguments);
    CHECK_THROWS_AS(after(arguments, cell_with(production_views())), CLI::ParseError);
  }
}

TEST_CASE("the settings as plan.json has them") {
  const auto json = [](const CandidateSet& set) { return config_of(set, kArea); };
  const auto production = json(production_views());
  CHECK(production["radii_m"].get<std::vector<double>>() == default_radii_m(kArea));
  CHECK(production["count"] == std::vector{20, 20});
  CHECK(production["rings"] == 0);
  CHECK(json(full_views())["radii_m"].size() == 3);
  CHECK(json(full_views())["rings"] == 2);
  const auto grid = json(BoxGrid{kArea, {2, 3, 4}, {1, 0.2}})["box_grid"];
  CHECK(grid["counts"] == std::vector{2, 3, 4});
  CHECK(grid["max_m"] == std::vector{0.3, 0.4, 0.2});
  CHECK(grid["ring_step_rad"] == 0.2);
  const auto around = json(AroundPath{{Pose(), Pose()}, 0.1, 0.2, 3})["around_path"];
  CHECK(around["path"] == 2);
  CHECK(around["count"] == 3);
  CHECK(json(ViewList{{Pose(), Pose()}})["views"] == 2);

  const auto usual = config_of(ViewConstraints{});
  CHECK(usual["camera_body"]["box"]["min_m"] == std::vector{-0.045, -0.0125, -0.021});
  CHECK(usual["clearance_m"] == 0.02);
  const auto none = config_of(ViewConstraints::bare());
  for (const char* key : {"shell", "box", "map"}) CHECK(none["reach"][key].is_null());
  CHECK(none["view_cone"].is_null());
  CHECK(none["camera_body"].is_null());
  CHECK(none["clearance_m"] == 0);
  const auto map = std::make_shared<const ReachMap>(ReachMap{{1, 2, 3}, 0.5, {1, 1, 2}, {0, 1}});
  const auto all = config_of(ViewConstraints{.reach = Reach{{0, 0, 1}, 0.2, 0.8},
                                             .reach_box = kArea,
                                             .reach_map = map,
                                             .view_cone = ViewCone{{0, 0, 1}, 0.4},
                                             .clearance_m = 0.05,
                                             .body = SphereBody{0.1}});
  CHECK(all["reach"]["shell"]["max_m"] == 0.8);
  CHECK(all["reach"]["box"]["min_m"] == std::vector{-0.3, -0.4, 0.0});
  CHECK(all["reach"]["map"]["size"] == std::vector{1, 1, 2});
  CHECK(all["view_cone"]["half_angle_rad"] == 0.4);
  CHECK(all["camera_body"]["sphere"]["radius_m"] == 0.1);
  CHECK(all["clearance_m"] == 0.05);
  const auto box = config_of(ViewConstraints{.body = BoxBody{kArea}});
  CHECK(box["camera_body"]["box"]["max_m"] == std::vector{0.3, 0.4, 0.2});
}

}  // namespace vantage::test
