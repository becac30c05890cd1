#include <doctest/doctest.h>

#include <map>

#include "python_check.hpp"
#include "run_command.hpp"
#include "vantage/raycore/image_io.hpp"
#include "vantage/reconstruction/bop_scene.hpp"
#include "vantage/reconstruction/color_image.hpp"

namespace vantage {
namespace {

using test::quoted;
using test::run_vantage;
namespace fs = std::filesystem;

/// Every file below a folder, by its path there.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).string()] = test::read_text(entry.path());
  }
  return files;
}

test::CommandResult simulate(const char* cell, const fs::path& folder,
                             const std::string& options = "") {
  return run_vantage("simulate" + test::quoted_workcell(cell) + " -o" + quoted(folder) +
                     " --samples 1 " + options);
}

}  // namespace

TEST_CASE("a simulated dataset is as BOP describes it, and agrees with its ground truth") {
  const test::TemporaryFolder folder;
  for (const char* cell : {"wall", "duck"}) {
    CAPTURE(cell);
    const auto result = simulate(cell, folder / cell, "--ideal-depth");
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    test::check_in_python("check_bop_dataset.py", folder / cell);
  }
}

TEST_CASE("the same seed gives the same files at any number of threads") {
  const test::TemporaryFolder folder;
  const std::string options = "--seed 5 --flying-pixels 0.2 --read-noise 0.01 --threads ";
  REQUIRE(simulate("clutter", folder / "one", options + "1").exit_code == 0);
  REQUIRE(simulate("clutter", folder / "three", options + "3").exit_code == 0);
  const auto one = files_of(folder / "one"), three = files_of(folder / "three");
  CHECK(one.size() > 10);
  CHECK(one == three);
  REQUIRE(simulate("clutter", folder / "other", "--seed 6 --threads 2").exit_code == 0);
  const auto other = files_of(folder / "other");
  CHECK(other.at("scene_gt.json") != one.at("scene_gt.json"));
  CHECK(other.at("depth/000000.png") != one.at("depth/000000.png"));
  CHECK(other.at("scene_camera.json") == one.at("scene_camera.json"));
}

TEST_CASE(
    "a simulated dataset is planned with its own workcell, and the predicted gain evaluated") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data", out = folder / "out";
  const auto recorded = simulate("two_pillars", data, "--json");
  CAPTURE(recorded.err);
  REQUIRE(recorded.exit_code == 0);
  const auto truth = recorded.json()["true_volumes_m3"];
  CHECK(truth["hidden"].get<double>() > 1e-4);

  const auto planned = run_vantage("plan" + quoted(data) + " --workcell" +
                                   quoted(data / "workcell.yaml") + " --json -o" + quoted(out));
  CAPTURE(planned.err);
  REQUIRE(planned.exit_code == 0);
  CHECK(planned.json()["volumes_m3"]["shadow"].get<double>() > 0.5 * truth["hidden"].get<double>());

  const auto judged = run_vantage("evaluate gain" + quoted(data / "workcell.yaml") +
                                  quoted(out / "plan.json") + " --json");
  CAPTURE(judged.err);
  REQUIRE(judged.exit_code == 0);
  const auto gain = judged.json();
  const auto best = planned.json()["best"];
  CHECK(gain["promised_m3"] == best["newly_observed_volume_m3"]);
  CHECK(gain["expected_m3"] == best["expected_volume_m3"]);
  CHECK(gain["shadow_m3"] == doctest::Approx(planned.json()["volumes_m3"]["shadow"].get<double>()));
  const double gained = gain["true_gain_m3"], expected = gain["expected_m3"];
  CHECK(gained > 0.8 * expected);
  CHECK(gained < 1.25 * expected);
  CHECK(gained >= gain["views"][0]["expected_interval_m3"][0].get<double>());
  CHECK(gained <= gain["views"][0]["expected_interval_m3"][1].get<double>());
  CHECK(gained <= gain["best_true_gain_m3"].get<double>());
  CHECK(gained >= 0.85 * gain["best_true_gain_m3"].get<double>());
  CHECK(gain["true_hidden_seen_m3"].get<double>() <= gain["true_hidden_m3"].get<double>());
  CHECK(gain["gain_of_hidden"].get<double>() > 0.8);

  const auto finer =
      run_vantage("evaluate gain" + quoted(data / "workcell.yaml") + quoted(out / "plan.json") +
                  " --voxel-size 0.005 --oracle none --json");
  REQUIRE(finer.exit_code == 0);
  CHECK(finer.json()["true_gain_m3"] == gain["true_gain_m3"]);
  CHECK(finer.json()["best_true_gain_m3"].is_null());
  CHECK(finer.json()["true_hidden_m3"] != gain["true_hidden_m3"]);
  CHECK(finer.json()["true_hidden_m3"].get<double>() ==
        doctest::Approx(gain["true_hidden_m3"].get<double>()).epsilon(0.2));
}

TEST_CASE("all views of a plan are evaluated in order, by its own sensor and filter") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data", out = folder / "out";
  REQUIRE(simulate("foreign_objects", data).exit_code == 0);
  const std::string plan = "plan" + quoted(data) + " --workcell" + quoted(data / "workcell.yaml") +
                           " --candidates production -o" + quoted(out) + " --views 2 ";
  const auto judge = [&](const std::string& options) {
    const auto planned = run_vantage(plan + options);
    CAPTURE(planned.err);
    REQUIRE(planned.exit_code == 0);
    const auto judged = run_vantage("evaluate gain" + quoted(data / "workcell.yaml") +
                                    quoted(out / "plan.json") + " --json");
    CAPTURE(judged.err);
    REQUIRE(judged.exit_code == 0);
    return judged.json();
  };
  const auto stereo = judge("");
  REQUIRE(stereo["views"].size() == 2);
  for (const auto& view : stereo["views"]) {
    CHECK(view["true_gain_m3"].get<double>() <= view["best_true_gain_m3"].get<double>());
    CHECK(view["expected_m3"].get<double>() <= view["expected_interval_m3"][1].get<double>());
  }
  CHECK(stereo["views"][1]["best_true_gain_m3"].get<double>() <
        stereo["views"][0]["best_true_gain_m3"].get<double>());
  // An ideal sensor gains more than a stereo camera at the same places does.
  const auto ideal = judge("--sensor ideal");
  CHECK(ideal["best_true_gain_m3"].get<double>() > stereo["best_true_gain_m3"].get<double>());
  const auto unfiltered = judge("--filter off");
  CHECK(unfiltered["shadow_m3"].get<double>() > 1.05 * stereo["shadow_m3"].get<double>());
}

TEST_CASE("a plan of another cell or dataset is not judged") {
  const test::TemporaryFolder folder;
  const fs::path one = folder / "one", two = folder / "two", out = folder / "out";
  REQUIRE(simulate("wall", one).exit_code == 0);
  REQUIRE(simulate("two_pillars", two).exit_code == 0);
  REQUIRE(run_vantage("plan" + quoted(two) + " --workcell" + quoted(two / "workcell.yaml") +
                      " --candidates production -o" + quoted(out))
              .exit_code == 0);
  const auto judged =
      run_vantage("evaluate gain" + quoted(one / "workcell.yaml") + quoted(out / "plan.json"));
  CHECK(judged.exit_code == 3);
  CHECK(judged.out.empty());
  CHECK(judged.err.find("SHA-256") != std::string::npos);
  CHECK(judged.err.find("plan.json") != std::string::npos);
}

TEST_CASE("random objects of the command line lie on the board and are in the truth") {
  const test::TemporaryFolder folder;
  const auto result =
      simulate("wall", folder / "data", "--objects 3 --types red_cube --seed 2 --json");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const auto truth = nlohmann::json::parse(test::read_text(folder / "data/scene_gt.json"));
  CHECK(truth["0"].size() == result.json()["known_objects"].get<std::size_t>());
  CHECK(truth["0"].size() == 8);
  // A name above others in the hierarchy stands for all of them.
  CHECK(simulate("wall", folder / "cubes", "--objects 3 --types cube").exit_code == 0);
  const auto unknown = simulate("wall", folder / "x", "--objects 3 --types red_cub");
  CHECK(unknown.exit_code == 3);
  CHECK(unknown.err.find("red_cube") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "x"));
}

TEST_CASE("a distorted recording has its calibration beside it") {
  const test::TemporaryFolder folder;
  const auto result = simulate("wall", folder / "data", "--distortion -0.1 0.02 0.001 0 0");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const std::string text = test::read_text(folder / "data/calibration.yml");
  CHECK(text.find("data: [ -0.1, 0.02, 0.001, 0, 0 ]") != std::string::npos);

  const fs::path cell = folder.write(
      "cell.yaml",
      "work_area: {min_m: [-0.1, -0.1, 0], max_m: [0.1, 0.1, 0.1]}\n"
      "known_objects: [{name: b, box: {min_m: [0, 0, 0], max_m: [0.1, 0.1, 0.1]}}]\n"
      "cameras:\n"
      "  - {name: a, eye_m: [1, 0, 0.5], target_m: [0, 0, 0]}\n"
      "  - {name: b, eye_m: [0, 1, 0.5], target_m: [0, 0, 0],\n"
      "     intrinsics: {width: 320, height: 240, fx: 300, fy: 300, cx: 160, cy: 120}}\n");
  const auto two = run_vantage("simulate" + quoted(cell) +
                               " --samples 1 --distortion 0.1 0 0 0 0 -o" + quoted(folder / "two"));
  CAPTURE(two.err);
  REQUIRE(two.exit_code == 0);
  CHECK(test::read_text(folder / "two/calibration_000001.yml").find("image_width: 320") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder / "two/calibration.yml"));
}

TEST_CASE("simulate writes over its own datasets, and over nothing else") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  REQUIRE(simulate("duck", data).exit_code == 0);
  CHECK(simulate("duck", data).exit_code == 0);

  fs::create_directories(folder / "mine/rgb");
  folder.write("mine/rgb/000000.png", "a real recording");
  const auto refused = simulate("duck", folder / "mine");
  CHECK(refused.exit_code == 3);
  CHECK(refused.err.find("nothing is lost") != std::string::npos);
  CHECK(test::read_text(folder / "mine/rgb/000000.png") == "a real recording");
}

TEST_CASE("what cannot be simulated is refused with the reason, and leaves nothing") {
  const test::TemporaryFolder folder;
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [0, 0, 0], max_m: [1, 1, 1]}\nknown_objects:\n  - {name: b, "
                   "box: {min_m: [0, 0, 0], max_m: [0.1, 0.1, 0.1]}}\n");
  const auto blind = run_vantage("simulate" + quoted(cell) + " -o" + quoted(folder / "data"));
  CHECK(blind.exit_code == 3);
  CHECK(blind.err.find("cell.yaml: cameras: there are no cameras") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "data"));

  const auto folded = simulate("duck", folder / "data", "--distortion -2 0 0 0 0");
  CHECK(folded.exit_code == 3);
  CHECK_FALSE(fs::exists(folder / "data"));
  const auto step = simulate("duck", folder / "data", "--disparity-step-px -1");
  CHECK(step.exit_code == 2);
  CHECK(step.err.find("--disparity-step-px: found '-1'; expected a number, 0 or above") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder / "data"));
  for (const char* options : {"--ideal-depth --border-px 4", "--ideal-depth --no-projector",
                              "--ideal-depth --no-second-imager", "--types duck"}) {
    CAPTURE(options);
    CHECK(simulate("duck", folder / "data", options).exit_code == 2);
  }
  CHECK(simulate("duck", folder / "data", "--types duck").err.find("--objects N") !=
        std::string::npos);

  const auto coarse = simulate("duck", folder / "data", "--depth-scale-mm 0.01");
  CHECK(coarse.exit_code == 3);
  CHECK(coarse.err.find("--depth-scale-mm") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "data"));
}

TEST_CASE("vantage render draws one camera's view, and contact sheets as PNG and JPEG") {
  const test::TemporaryFolder folder;
  const std::string duck = test::quoted_workcell("duck");
  const fs::path single = folder / "view.png", sheet = folder / "sheet.jpg";
  REQUIRE(run_vantage("render" + duck + " --samples 1 -o" + quoted(single)).exit_code == 0);
  CHECK(read_color(single).width == 640);
  REQUIRE(run_vantage("render" + duck + test::quoted_workcell("wall") +
                      " --contact-sheet --samples 1 -o" + quoted(sheet))
              .exit_code == 0);
  CHECK(read_color(sheet).width > 600);

  const auto camera = run_vantage("render" + duck + " --camera nobody -o" + quoted(single));
  CHECK(camera.exit_code == 3);
  CHECK(camera.err.find("the workcell's cameras are") != std::string::npos);
  const auto ending = run_vantage("render" + duck + " --samples 1 -o" + quoted(folder / "v.gif"));
  CHECK(ending.exit_code == 3);
  CHECK(ending.err.find("expected .png or .jpg") != std::string::npos);
}

}  // namespace vantage
