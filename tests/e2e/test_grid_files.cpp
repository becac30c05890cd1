#include <doctest/doctest.h>

#include "python_check.hpp"
#include "run_command.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr const char* kArguments =
    " --servo 0 --polish 0 --count 1 --save-grid --save-surface -o '";

void check_in_python(const fs::path& plan) {
  test::check_in_python("check_grid_files.py", plan);
}

}  // namespace

TEST_CASE("NumPy and Debian's OpenVDB read the volumes of plan.json from the files: raw depth") {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  // Wider than the camera's view: some of the shadow is unseen.
  const auto result =
      test::run_vantage("plan '" + test::write_scene(folder).string() +
                        "' --work-area -0.5 -0.4 0.02 0.5 0.5 0.22 --voxel-size 0.01 --json" +
                        kArguments + out + "'");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.json()["volumes_m3"]["shadow_unseen"] > 0.001);
  CHECK(result.json()["volumes_m3"]["shadow_hidden"] > 0.001);
  check_in_python(out);
}

TEST_CASE("NumPy and Debian's OpenVDB read the volumes of plan.json from the files: objects") {
  const test::TemporaryFolder folder;
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [-0.203, -0.1, 0.02], max_m: [0.207, 0.31, 0.2232]}\n"
                   "voxel_size_m: 0.007\n"
                   "volume: {occluders: voxels, filter: off}\n"
                   "known_objects:\n"
                   "  - name: box\n"
                   "    box: {min_m: [-0.08, 0, 0], max_m: [0.08, 0.06, 0.15]}\n");
  const std::string out = (folder / "out").string();
  const auto result =
      test::run_vantage("plan '" + test::write_scene(folder).string() + "' --workcell '" +
                        cell.string() + "'" + kArguments + out + "'");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  check_in_python(out);
}

TEST_CASE("NumPy and Debian's OpenVDB read the volumes of plan.json from the files: a recording") {
  const auto scene = test::recording("osd_learn0");
  if (!scene) return;
  const test::TemporaryFolder folder;
  const auto result = test::run_vantage("plan '" + scene->string() +
                                        "' --work-area -0.25 -0.15 0.005 0.25 0.35 0.27 "
                                        "--voxel-size 0.005" +
                                        kArguments + folder.path().string() + "'");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  check_in_python(folder.path());
}

}  // namespace vantage
