#include <doctest/doctest.h>

#include "run_command.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage {
namespace {

using test::run_vantage;
using test::TemporaryFolder;
namespace fs = std::filesystem;

/// Exit code, and every part in stderr; nothing on stdout, and no file written.
void expect_failure(const std::string& options, int exit_code,
                    std::initializer_list<std::string_view> parts) {
  const TemporaryFolder folder;
  const auto result = run_vantage(options + " -o '" + (folder / "out").string() + "'");
  CAPTURE(options);
  CAPTURE(result.err);
  CHECK(result.exit_code == exit_code);
  CHECK(result.out.empty());
  CHECK((!fs::exists(folder / "out") || fs::is_empty(folder / "out")));
  for (const std::string_view part : parts) {
    CAPTURE(part);
    CHECK(result.err.find(part) != std::string::npos);
  }
}

std::string plan(const fs::path& scene) {
  return "plan '" + scene.string() + "'" + test::kSceneArea;
}

void expect_bad_camera(const char* key, const nlohmann::json& value,
                       std::initializer_list<std::string_view> parts) {
  const TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  nlohmann::json entry = test::scene_camera();
  entry[key] = value;
  test::write_scene_camera(scene, entry);
  expect_failure(plan(scene), 3, parts);
}

void expect_bad_workcell(const std::string& yaml, std::initializer_list<std::string_view> parts) {
  const TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n");
  folder.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
  folder.write("claims.ply",
               "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
               "property float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n0123456789");
  const fs::path cell = folder.write(
      "cell.yaml", "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n" + yaml);
  expect_failure("plan '" + scene.string() + "' --workcell '" + cell.string() + "'", 3, parts);
}

}  // namespace

TEST_CASE("missing files") {
  const TemporaryFolder folder;
  expect_failure(plan(folder / "nowhere"), 3, {"nowhere"});
  const fs::path scene = test::write_scene(folder);
  fs::remove(scene / "depth/000007.png");
  expect_failure(plan(scene), 3, {"000007.png"});
  test::write_scene(folder);
  fs::remove(scene / "scene_camera.json");
  expect_failure(plan(scene), 3, {"scene_camera.json"});
  expect_failure("plan '" + scene.string() + "' --workcell '" + (folder / "no.yaml").string() + "'",
                 3, {"no.yaml"});
}

TEST_CASE("a truncated depth PNG") {
  const TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder), png = scene / "depth/000007.png";
  fs::resize_file(png, fs::file_size(png) / 2);
  expect_failure(plan(scene), 3, {"000007.png"});
}

TEST_CASE("an 8-bit depth PNG") {
  const TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  write_png(scene / "depth/000007.png", ColorImage(320, 240, 90));
  expect_failure(plan(scene), 3, {"000007.png", "16"});
}

TEST_CASE("depth and intrinsics of different size") {
  const TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  write_png(scene / "depth/000007.png", RawDepthImage(80, 60, 900));
  expect_failure(plan(scene), 3, {"80", "60", "scale cam_K by 0.25"});
}

TEST_CASE("invalid intrinsics and poses") {
  expect_bad_camera("cam_K", {-300, 0, 159.5, 0, 300, 119.5, 0, 0, 1},
                    {"scene_camera.json", "\"7\"", "-300"});
  expect_bad_camera("cam_K", {0, 0, 159.5, 0, 300, 119.5, 0, 0, 1}, {"scene_camera.json", "fx"});
  expect_bad_camera("cam_R_w2c", {1, 0, 0, 0, 1, 0, 0, 0, 2}, {"cam_R_w2c", "not a rotation"});
  expect_bad_camera("cam_R_w2c", {1, 0, 0, 0, 1, 0, 0, 0, -1}, {"cam_R_w2c", "reflection"});
  expect_bad_camera("depth_scale", -1, {"depth_scale", "-1"});
}

TEST_CASE("an unknown key in a workcell, with the nearest known one") {
  expect_bad_workcell("voxel_siz_m: 0.01\n", {"cell.yaml:2", "voxel_siz_m", "voxel_size_m"});
}

TEST_CASE("damaged meshes") {
  expect_bad_workcell("known_objects: [{name: a, mesh: nan.obj}]\n", {"nan.obj:3"});
  expect_bad_workcell("known_objects: [{name: a, mesh: range.obj}]\n", {"range.obj:4", "4"});
  expect_bad_workcell("known_objects: [{name: a, mesh: claims.ply}]\n",
                      {"claims.ply", "4000000000"});
}

TEST_CASE("an unknown instruction set") {
  const TemporaryFolder folder;
  const auto result =
      run_vantage("demo -o '" + (folder / "out").string() + "'", "VANTAGE_MAX_ISA=avx3");
  CHECK(result.exit_code == 3);
  CHECK(result.err.find("VANTAGE_MAX_ISA: the environment variable is 'avx3'; expected sse4.2") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("wrong usage is exit code 2") {
  const TemporaryFolder folder;
  const std::string scene = test::write_scene(folder).string();
  expect_failure("plan '" + scene + "'", 2, {"--work-area"});
  expect_failure("plan '" + scene + "'" + test::kSceneArea + " --method wishful", 2, {"wishful"});
  expect_failure("plan '" + scene + "' --work-area 0 0 0 1 1", 2, {"--work-area"});
  for (const char* option :
       {"--occluders boxes", "--anti-alias perhaps", "--band-sigmas -1", "--depth-noise-px -0.1"}) {
    const std::string name(option, std::string_view(option).find(' '));
    expect_failure("plan '" + scene + "'" + test::kSceneArea + " " + option, 2, {name});
  }
  expect_failure("frobnicate", 2, {});
}

TEST_CASE("options that make no sense are bad input") {
  const TemporaryFolder folder;
  const std::string scene = "plan '" + test::write_scene(folder).string() + "'";
  expect_failure(scene + " --work-area 0 0 0 1 1 0", 3, {"--work-area"});
  expect_failure(scene + test::kSceneArea + " --depth-range 3 1", 3, {"--depth-range"});
  expect_failure(scene + test::kSceneArea + " --images 9", 3, {"9"});
  expect_failure(scene + " --work-area 0 0 0 1 1 1 --voxel-size -1", 2,
                 {"--voxel-size", "found '-1'", "above 0"});
  expect_failure(scene + " --work-area 0 0 0 1 1 1 --voxel-size 0.0001", 6, {"voxel size"});
}

TEST_CASE("an output folder that cannot be made") {
  const TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  folder.write("file", "in the way");
  const auto result = run_vantage(plan(scene) + " -o '" + (folder / "file/out").string() + "'");
  CHECK(result.exit_code == 3);
  CHECK(result.err.find("file/out") != std::string::npos);
  CHECK(test::read_text(folder / "file") == "in the way");
}

}  // namespace vantage
