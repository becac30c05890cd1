// Recordings over time.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "run_command.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::quoted;
using test::run_vantage;
namespace fs = std::filesystem;

/// Two cameras of 320 × 240 before a board with a cube on it, which moves once.
std::string two_camera_cell() {
  const std::string assets = test::assets().string();
  return fmt::format(R"(
work_area: {{min_m: [-0.3, -0.2, 0], max_m: [0.3, 0.2, 0.15]}}
knowledge_base: {0}/knowledge/cubes.yaml
board: {0}/workcells/boards/board_70x50.yaml
known_objects:
  - {{name: cube, type: red_cube, pose: {{translation_m: [-0.1, 0, 0.025]}}}}
cameras:
  - {{name: left, eye_m: [-0.42, -0.4, 0.5], target_m: [0, 0, 0], intrinsics: {{width: 320, height: 240, fx: 307, fy: 307, cx: 159.5, cy: 119.5}}}}
  - {{name: back, eye_m: [0, 0.55, 0.5], target_m: [0, 0, 0], intrinsics: {{width: 320, height: 240, fx: 307, fy: 307, cx: 159.5, cy: 119.5}}}}
sequence:
  instants: 5
  delays: [{{camera: back, delay_s: 0.1}}]
  move_objects: [{{object: cube, from_s: 0.15, to_s: 0.25, pose: {{translation_m: [0.1, 0.05, 0.025]}}}}]
)",
                     assets);
}

test::CommandResult record(const fs::path& cell, const fs::path& folder,
                           const std::string& options = "") {
  return run_vantage("simulate" + quoted(cell) + " -o" + quoted(folder) +
                     " --sequence --samples 1 " + options);
}

double true_x(const json& scene_gt, const fs::path& folder, int camera) {
  const BopScene scene = load_bop_scene(folder, {});
  const json& entry = scene_gt[std::to_string(camera)][0];
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = entry["cam_R_m2c"][std::size_t(i)];
  Eigen::Vector3d place;
  for (int i = 0; i < 3; ++i) place[i] = entry["cam_t_m2c"][std::size_t(i)].get<double>() / 1000;
  const Pose T_cam_object = Pose::from_rotation(rotation, place);
  return (*scene.images[std::size_t(camera)].T_world_cam * T_cam_object).translation().x();
}

}  // namespace

TEST_CASE("a sequence is one BOP scene for each instant, with its truth beside them") {
  const test::TemporaryFolder folder;
  const fs::path cell = folder.write("cell.yaml", two_camera_cell());
  const auto result = record(cell, folder / "out");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json sequence = json::parse(test::read_text(folder / "out/sequence.json"));
  CHECK_NOTHROW(check_schema(Document{"sequence.json", sequence}, sequence_schema()));
  REQUIRE(sequence["instants"].size() == 5);
  REQUIRE(sequence["events"].size() == 1);
  CHECK(sequence["events"][0]["kind"] == "moved");
  CHECK(sequence["instants"][2]["objects"][0]["carried"] == true);
  CHECK(sequence["instants"][1]["camera_times_s"][1].get<double>() == doctest::Approx(0.2));
  std::set<std::string> pictures;
  for (const json& instant : sequence["instants"]) {
    const fs::path scene = folder / "out" / instant["folder"].get<std::string>();
    const json truth = json::parse(test::read_text(scene / "scene_gt.json"));
    const double x = instant["objects"][0]["T_world_object"]["translation_m"][0];
    CHECK(true_x(truth, scene, 0) == doctest::Approx(x));
    pictures.insert(test::read_text(scene / "rgb/000000.png"));
  }
  CHECK(pictures.size() >= 3);  // before, on the way, after
  // The camera that is out of step sees the cube at its new place an instant earlier.
  const fs::path second = folder / "out/000002";
  CHECK(true_x(json::parse(test::read_text(second / "scene_gt.json")), second, 1) ==
        doctest::Approx(0.1));
  CHECK(fs::exists(folder / "out/models/models_info.json"));
}

TEST_CASE("each instant of a sequence is reconstructed with the sequence's workcell") {
  const test::TemporaryFolder folder;
  const fs::path cell = folder.write("cell.yaml", two_camera_cell());
  REQUIRE(record(cell, folder / "out", "--no-arm").exit_code == 0);
  const auto result = run_vantage("reconstruct" + quoted(folder / "out/000004") + " --workcell" +
                                  quoted(folder / "out/workcell.yaml") + " --json");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json objects = result.json()["objects"];
  REQUIRE(objects.size() == 1);
  CHECK(std::abs(objects[0]["T_world_object"]["translation_m"][0].get<double>() - 0.1) < 0.003);
}

TEST_CASE("sequences that cannot be recorded are refused with the reason") {
  const test::TemporaryFolder folder;
  const fs::path cell = folder.write("cell.yaml", two_camera_cell());
  const auto refused = [&](const std::string& options, int exit_code, const char* reason) {
    CAPTURE(options);
    const auto result = record(cell, folder / "out", options);
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    CHECK(result.err.find(reason) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  refused("--delay above=0.1", 3, "above");
  refused("--delay back", 3, "CAMERA=SECONDS");
  refused("--delay back=soon", 3, "CAMERA=SECONDS");
  refused("--instants 0", 2, "--instants");
  refused("--moves 3", 3, "random");
}

}  // namespace vantage
