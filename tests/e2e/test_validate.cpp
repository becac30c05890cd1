#include <doctest/doctest.h>

#include "run_command.hpp"

namespace vantage {
namespace {

using test::run_vantage;

test::CommandResult validate(const std::filesystem::path& scene, const std::string& options = "") {
  return run_vantage("validate" + test::quoted(scene) + test::kSceneArea + options);
}

}  // namespace

TEST_CASE("validate: a recording that fits has no findings and exit code 0") {
  const test::TemporaryFolder folder;
  const auto scene = test::write_scene(folder);
  const auto result = validate(scene);
  CAPTURE(result.out);
  CHECK(result.exit_code == 0);
  CHECK(result.out.find("findings   none") != std::string::npos);
  CHECK(validate(scene, " --json").json()["findings"].empty());
}

TEST_CASE(
    "validate: a depth scale and poses that do not fit are named with exit code 3, and plan "
    "warns") {
  const test::TemporaryFolder folder;
  const auto scene = test::write_scene(folder);
  nlohmann::json entry = test::scene_camera();
  entry["depth_scale"] = 1000.0;
  test::write_scene_camera(scene, entry);
  const auto scaled = validate(scene);
  CHECK(scaled.exit_code == 3);
  CHECK(scaled.out.find("check depth_scale") != std::string::npos);

  // The pose of the camera in the world, in place of the world's in the camera.
  entry = test::scene_camera();
  entry["cam_R_w2c"] = {1, 0, 0, 0, -0.5, 0.8660254037844386, 0, -0.8660254037844386, -0.5};
  entry["cam_t_w2c"] = {0, -600, 400};
  test::write_scene_camera(scene, entry);
  const auto inverted = validate(scene, " --json");
  CHECK(inverted.exit_code == 3);
  const auto findings = inverted.json()["findings"];
  REQUIRE(findings.size() >= 1);
  CHECK(findings[0].get<std::string>().find("camera-to-world poses were given") !=
        std::string::npos);

  const auto plan = run_vantage("plan" + test::quoted(scene) + test::kSceneArea + " --json");
  CHECK(plan.err.find("camera-to-world poses were given") != std::string::npos);
  CHECK(plan.json()["warnings"] == findings);
}

}  // namespace vantage
