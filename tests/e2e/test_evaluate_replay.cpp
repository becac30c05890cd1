#include <doctest/doctest.h>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "run_command.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::quoted;
using test::run_vantage;
namespace fs = std::filesystem;

constexpr const char* kTable = " --work-area -0.7 -0.75 0 1.1 0.65 0.35";

/// The scene with one depth image, three times over: as images 7, 8 and 9 of one camera.
fs::path write_three_frames(const test::TemporaryFolder& folder, json entry) {
  const fs::path scene = test::write_scene(folder);
  for (const char* name : {"000008.png", "000009.png"}) {
    fs::copy_file(scene / "depth/000007.png", scene / "depth" / name);
  }
  folder.write("scene/scene_camera.json",
               json{{"7", entry}, {"8", entry}, {"9", std::move(entry)}}.dump());
  return scene;
}

}  // namespace

TEST_CASE("replay of a real recording: the pick is among the best frames, far above the mean") {
  const auto kitchen = test::recording("kitchen");
  if (!kitchen) return;
  const test::TemporaryFolder folder;
  const auto result =
      run_vantage("evaluate replay" + quoted(*kitchen) + kTable +
                  " --voxel-size 0.04 --pairs 4 --methods voxel,mesh -o" + quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find("Means over 4 pairs of frames") != std::string::npos);
  const json report = json::parse(test::read_text(folder / "out/replay.json"));
  CHECK_NOTHROW(check_schema({"replay.json", report}, replay_schema()));
  CHECK(report["inputs"].size() == 101);
  CHECK(report["config"]["pairs"] == 4);
  REQUIRE(report["pairs"].size() == 4);
  for (const json& pair : report["pairs"]) {
    CHECK(pair["views"].size() == 48);
    CHECK(pair["best_gain_m3"].get<double>() < pair["shadow_m3"].get<double>());
  }
  REQUIRE(report["methods"].size() == 2);
  for (const json& method : report["methods"]) {
    CAPTURE(method["method"]);
    CHECK(method["share_of_best"].get<double>() > 0.9);
    CHECK(method["times_mean"].get<double>() > 1.5);
  }
  CHECK(report["any_frame_share_of_best"].get<double>() < 0.6);
}

TEST_CASE("a replay is the same bytes at any number of threads") {
  const auto kitchen = test::recording("kitchen");
  if (!kitchen) return;
  const std::string command = "evaluate replay" + quoted(*kitchen) + kTable +
                              " --images 0,100,200,300,400 --voxel-size 0.05 --pairs 3 --json";
  const auto one = run_vantage(command + " --threads 1");
  CHECK(one.exit_code == 0);
  CHECK(one.out == run_vantage(command + " --threads 3").out);
  CHECK(one.out != run_vantage(command + " --seed 1").out);
}

TEST_CASE("evaluate replay refuses what it cannot replay, and writes nothing") {
  const test::TemporaryFolder good, unposed, flat, single, folder;
  const std::string methods = " --methods voxel";
  const auto refused = [&](const fs::path& scene, const std::string& options, int exit_code,
                           const std::vector<std::string>& parts) {
    CAPTURE(options);
    const auto result = run_vantage("evaluate replay" + quoted(scene) + methods + options + " -o" +
                                    quoted(folder / "out"));
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    for (const std::string& part : parts) {
      CAPTURE(part);
      CHECK(result.err.find(part) != std::string::npos);
    }
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  const fs::path scene = write_three_frames(good, test::scene_camera());
  refused(scene, "", 2, {"--work-area"});
  refused(scene, test::kSceneArea + " --pairs 0", 2, {"--pairs"});
  refused(scene, test::kSceneArea + " --methods magic", 3, {"--methods", "found 'magic'"});
  refused(scene, " --work-area 5 5 0 6 6 1 --voxel-size 0.05", 3,
          {"work area", "of 3 frames, 0 show at least 10 % of it"});
  refused(scene, test::kSceneArea + " --mesh-step 2", 2,
          {"--mesh-step: does nothing without mesh among --methods"});
  refused(scene, test::kSceneArea + " --filter off --filter-edge 0.1", 2, {"--filter-edge"});
  refused(scene, test::kSceneArea + " --images 7,9", 3, {"dataset", "found 2 frames"});

  json entry = test::scene_camera();
  entry.erase("cam_R_w2c");
  entry.erase("cam_t_w2c");
  refused(write_three_frames(unposed, entry), test::kSceneArea, 3, {"\"7\": cam_R_w2c", "missing"});

  entry = test::scene_camera();
  entry["width"] = 320;
  entry["height"] = 240;
  const fs::path without_depth = write_three_frames(flat, entry);
  fs::remove_all(without_depth / "depth");
  refused(without_depth, test::kSceneArea, 3, {"image 7", "it has no depth image"});
}

TEST_CASE("frames that show the same reveal nothing, and the report says so") {
  const test::TemporaryFolder folder;
  const auto result =
      run_vantage("evaluate replay" + quoted(write_three_frames(folder, test::scene_camera())) +
                  test::kSceneArea + " --methods voxel --json");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json report = result.json();
  CHECK_NOTHROW(check_schema({"replay.json", report}, replay_schema()));
  CHECK(report["pairs"].size() == 3);
  CHECK(report["pairs"][0]["best_gain_m3"] == 0.0);
  CHECK(report["methods"][0]["share_of_best"].is_null());
  CHECK(report["any_frame_share_of_best"].is_null());
}

TEST_CASE("Ctrl-C ends a replay with 130, and what is finished is written") {
  const auto kitchen = test::recording("kitchen");
  if (!kitchen) return;
  const test::TemporaryFolder folder;
  const auto result = test::interrupt_vantage(
      "evaluate replay" + quoted(*kitchen) + kTable +
          " --voxel-size 0.01 --pairs 1000 --methods voxel -o" + quoted(folder / "out"),
      8);
  CHECK(result.exit_code == 130);
  CHECK(result.out.find("Means over") != std::string::npos);
  const auto report = nlohmann::json::parse(test::read_text(folder / "out/replay.json"));
  CHECK(report["partial"] == true);
  CHECK(report["pairs"].size() >= 1);
  CHECK(report["pairs"].size() < 1000);
}

}  // namespace vantage
