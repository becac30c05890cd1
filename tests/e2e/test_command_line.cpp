#include <doctest/doctest.h>

#include "run_command.hpp"

namespace vantage {
namespace {

using test::CommandResult;
using test::run_vantage;
using test::TemporaryFolder;
namespace fs = std::filesystem;

/// Runs `plan` on the scene of the tests with more options.
CommandResult plan_with(const TemporaryFolder& folder, const std::string& options,
                        const std::string& prefix = "") {
  return run_vantage("plan" + test::quoted(folder / "scene") + " --voxel-size 0.02 " + options,
                     prefix);
}

void expect_exit(const CommandResult& result, int exit_code,
                 std::initializer_list<std::string_view> parts) {
  CAPTURE(result.err);
  CHECK(result.exit_code == exit_code);
  const std::string all = result.out + result.err;
  CAPTURE(all);
  for (const std::string_view part : parts) {
    CAPTURE(part);
    CHECK(all.find(part) != std::string::npos);
  }
}

const std::string kArea = " --work-area -0.2 -0.1 0.02 0.2 0.3 0.22 ";

}  // namespace

TEST_CASE("options that do nothing without another one are refused with both names") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  for (const auto& [options, one, other] :
       {std::tuple("--from 0 0 1", "--from", "--travel-weight"),
        std::tuple("--travel-weight 1", "--travel-weight", "--from"),
        std::tuple("--least-gain 0.001", "--least-gain", "--views"),
        std::tuple("--least-gain-share 0.1 --views 1", "--least-gain-share", "--views"),
        std::tuple("--mesh-step 2", "--mesh-step", "--method mesh"),
        std::tuple("--mesh-weight depth --method shadow", "--mesh-weight", "--method mesh"),
        std::tuple("--depth-power 3", "--depth-power", "--method shadow"),
        std::tuple("--depth-power 3 --method mesh --mesh-weight volume", "--depth-power",
                   "--mesh-weight depth"),
        std::tuple("--value bound --method shadow", "--value", "--method voxel"),
        std::tuple("--servo-width 64 --servo 0", "--servo-width", "--servo"),
        std::tuple("--filter-edge 0.1 --filter off", "--filter-edge", "--filter"),
        std::tuple("--ring-step 0.1", "--ring-step", "--rings"),
        std::tuple("--inlier-px 2 --objects given", "--inlier-px", "--objects"),
        std::tuple("--cameras board", "--cameras", "--objects")}) {
    CAPTURE(options);
    expect_exit(plan_with(folder, kArea + options), 2, {one, other});
  }
}

TEST_CASE("with the other one they are accepted, wherever it is set") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  folder.write("cell.yaml",
               "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
               "plan: {travel: {from_m: [0, 0, 1], weight_per_m: 0.1}, views: {most: 2}}\n");
  expect_exit(plan_with(folder, "--workcell" + test::quoted(folder / "cell.yaml") +
                                    " --from 0 0 2 --least-gain 0.0001"),
              0, {"next view"});
}

TEST_CASE("options of pictures without pictures change nothing and cause a warning") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  expect_exit(plan_with(folder, kArea + std::string(" --picture-width 700")), 0,
              {"--picture-width does nothing without --pictures"});
}

TEST_CASE("a number may begin with a dot") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  expect_exit(plan_with(folder, "--work-area -.2 -.1 .02 +.2 .3 .22"), 0, {"next view"});
}

TEST_CASE("empty values are refused by name") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  for (const char* options : {"-o \"\"", "--objects \"\"", "--workcell \"\"", "--candidates ''"}) {
    CAPTURE(options);
    const std::string name = std::string(options).substr(0, std::string(options).find(' '));
    expect_exit(plan_with(folder, kArea + options), 2, {name == "-o" ? "--output" : name, "empty"});
  }
  expect_exit(run_vantage("plan \"\"" + kArea), 2, {"dataset", "empty"});
}

TEST_CASE("the floor is a setting, and the summary names it where it forbids most") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  const std::string high = kArea + "--floor-z 5";
  expect_exit(plan_with(folder, high), 4, {"below the floor", "--floor-z", "z = 5 m"});
  expect_exit(plan_with(folder, kArea + "--floor-z none"), 0, {"next view"});
  expect_exit(plan_with(folder, kArea + "--floor-z low"), 2, {"found 'low'", "or none"});
  folder.write("cell.yaml",
               "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
               "floor_z_m: none\n");
  const auto json = plan_with(folder, "--json --workcell" + test::quoted(folder / "cell.yaml"));
  REQUIRE(json.exit_code == 0);
  CHECK(json.json()["config"]["constraints"]["floor_z_m"].is_null());
}

TEST_CASE("surfaces that noise makes thicker than the work area are warned of") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  nlohmann::json camera = test::scene_camera();
  camera["depth_scale"] = 100.0;
  camera["cam_t_w2c"] = {0, 4641.016151377539, 71961.52422706632};
  test::write_scene_camera(folder / "scene", camera);
  expect_exit(run_vantage("plan" + test::quoted(folder / "scene") +
                          " --work-area -20 -10 2 20 30 22 --voxel-size 1 --depth-range 1 200"),
              0, {"warning", "thick", "depth range"});
  test::write_scene_camera(folder / "scene", test::scene_camera());
  const CommandResult usual = plan_with(folder, kArea);
  CHECK(usual.err.find("thick") == std::string::npos);
}

TEST_CASE("no bytes of files reach the terminal as they are") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  folder.write("cell.yaml",
               "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
               "\"evil\\e[2J\\x9b1m\": 1\n");
  const CommandResult result = plan_with(folder, "--workcell" + test::quoted(folder / "cell.yaml"));
  expect_exit(result, 3, {"evil\\x1b[2J\\xc2\\x9b1m", "cell.yaml:2"});
  CHECK(result.err.find('\x1b') == std::string::npos);
  const CommandResult usage = plan_with(folder, "--objects-\"$(printf '\\033[2J')\" 1");
  expect_exit(usage, 2, {"\\x1b[2J"});
  CHECK(usage.err.find('\x1b') == std::string::npos);
}

}  // namespace vantage
