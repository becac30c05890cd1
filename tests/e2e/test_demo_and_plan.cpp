#include <doctest/doctest.h>

#include <algorithm>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "run_command.hpp"
#include "vantage/reconstruction/color_image.hpp"

namespace vantage {
namespace {

using test::run_vantage;
namespace fs = std::filesystem;

nlohmann::json without_times(nlohmann::json plan) {
  plan.erase("timing_ms");
  return plan;
}

double revealed_share(const nlohmann::json& plan) {
  return plan["best"]["newly_observed_volume_m3"].get<double>() /
         plan["volumes_m3"]["shadow"].get<double>();
}

using Pixel = const std::uint8_t*;
bool is_red(Pixel p) {
  return p[0] > 150 && p[1] < 60 && p[2] < 60;
}
bool is_green(Pixel p) {
  return p[1] > p[0] + 30 && p[1] > p[2] + 30;
}
bool is_cyan(Pixel p) {
  return p[1] > p[0] + 25 && p[2] > p[0] + 25;
}

double share_of(const ColorImage& image, bool (*matches)(Pixel)) {
  int count = 0;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) count += matches(image.pixel(u, v));
  }
  return double(count) / (image.width * image.height);
}

}  // namespace

TEST_CASE("vantage demo plans, and draws what it found") {
  const test::TemporaryFolder folder;
  const auto result = run_vantage("demo --picture-width 640 -o '" + folder.path().string() + "'");
  CHECK(result.exit_code == 0);
  CHECK(result.out.find("next view  candidate") == 0);
  const ColorImage overview = read_color(folder / "overview.png");
  CHECK(overview.width == 640);
  CHECK(share_of(overview, is_red) > 0.003);  // the suggested camera
  CHECK(share_of(overview, is_green) > 0.01);
  CHECK(share_of(overview, is_cyan) > 0.01);
  const ColorImage view = read_color(folder / "view.png");
  CHECK(view.width == 640);
  CHECK(view.height == 480);
  CHECK(share_of(view, is_red) < 1e-4);  // it sees no shadow but what it reveals, and not itself
  CHECK(share_of(view, is_cyan) > 0.03);
  const auto plan = nlohmann::json::parse(test::read_text(folder / "plan.json"));
  CHECK_NOTHROW(check_schema({"plan.json", plan}, plan_schema()));
  CHECK(plan["candidates"].size() == 40);
  CHECK(plan["best"]["T_world_cam"]["translation_m"][1].get<double>() > 0.2);  // behind the wall
  CHECK(revealed_share(plan) > 0.8);
  CHECK(revealed_share(plan) < 1);
}

TEST_CASE("vantage plan looks behind what stands in a depth image") {
  const test::TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder), out = folder / "out/deep";
  const auto result =
      run_vantage("plan '" + scene.string() + "'" + test::kSceneArea + " -o '" + out.string() +
                  "' --save-grid --save-surface --save-scene --json");
  CAPTURE(result.err);
  CHECK(result.exit_code == 0);
  CHECK(result.out == test::read_text(out / "plan.json"));
  const nlohmann::json plan = result.json();
  CHECK_NOTHROW(check_schema({"plan.json", plan}, plan_schema()));
  CHECK(plan["best"]["T_world_cam"]["translation_m"][1].get<double>() > 0.3);
  CHECK(plan["inputs"].size() == 2);
  const nlohmann::json& volumes = plan["volumes_m3"];
  CHECK(volumes["shadow_hidden"].get<double>() + volumes["shadow_unmeasured"].get<double>() +
            volumes["shadow_outside"].get<double>() ==
        doctest::Approx(volumes["shadow"].get<double>()).scale(0));
  CHECK(plan["anti_alias"]["applied"] == false);
  // The box's shadow is by far the largest; it lies behind the box.
  const nlohmann::json& largest = plan["shadow_regions"]["largest"][0];
  CHECK(largest["volume_m3"] > 0.5 * volumes["shadow"].get<double>());
  CHECK(largest["centroid_m"][1] > 0.06);
  for (const char* name :
       {"grid.vdb", "labels.npy", "regions.npy", "shadow.ply", "shadow_smooth.ply", "scene.glb"}) {
    CHECK(fs::exists(out / name));
  }
  // Nothing temporary is left behind.
  CHECK(std::distance(fs::directory_iterator(out), fs::directory_iterator()) == 7);
}

TEST_CASE("the plan is the same at 1, 2, 3 and 8 threads") {
  const test::TemporaryFolder folder;
  const std::string plan = "plan '" + test::write_scene(folder).string() + "'" + test::kSceneArea;
  const nlohmann::json first = without_times(run_vantage(plan + " --json --threads 1").json());
  for (const char* threads : {"2", "3", "8"}) {
    CHECK(without_times(run_vantage(plan + " --json --threads " + threads).json()) == first);
  }
}

TEST_CASE("a workcell file adds known objects, and the command line wins over it") {
  const test::TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
                   "voxel_size_m: 0.02\n"
                   "known_objects:\n"
                   "  - name: box\n"
                   "    box: {min_m: [-0.08, 0, 0], max_m: [0.08, 0.06, 0.15]}\n");
  const std::string plan =
      "plan '" + scene.string() + "' --workcell '" + cell.string() + "' --json";
  const nlohmann::json coarse = run_vantage(plan).json();
  CHECK(coarse["voxel_size_m"] == 0.02);
  CHECK(coarse["inputs"].size() == 3);
  const nlohmann::json fine = run_vantage(plan + " --voxel-size 0.01").json();
  CHECK(fine["voxel_size_m"] == 0.01);
  CHECK(fine["volumes_m3"]["occupied"].get<double>() >= 0.16 * 0.06 * 0.13 * 0.99);
}

TEST_CASE("settings of the volume: defaults, a workcell's, and the command line's over both") {
  const test::TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  const std::string plan = "plan '" + scene.string() + "'" + test::kSceneArea + " --json";
  const auto options = [](const test::CommandResult& result) {
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    return result.json()["config"]["volume"];
  };
  const nlohmann::json noise = {{"focal_px", 424.0}, {"baseline_m", 0.05}, {"subpixel_px", 0.08}};
  CHECK(options(run_vantage(plan)) == nlohmann::json{{"occluders", "mesh"},
                                                     {"anti_alias", false},
                                                     {"band_sigmas", 4.0},
                                                     {"filter", "auto"},
                                                     {"filter_m", 0.02},
                                                     {"noise", noise}});
  CHECK(options(run_vantage(plan + " --occluders voxels"))["anti_alias"] == true);
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
                   "volume: {occluders: voxels, band_sigmas: 3, noise: {subpixel_px: 0.1}}\n");
  const std::string with_cell = plan + " --workcell '" + cell.string() + "'";
  const nlohmann::json from_cell = options(run_vantage(with_cell));
  CHECK(from_cell["occluders"] == "voxels");
  CHECK(from_cell["band_sigmas"] == 3.0);
  CHECK(from_cell["noise"]["subpixel_px"] == 0.1);
  CHECK(
      options(run_vantage(with_cell + " --occluders mesh --anti-alias on --band-sigmas 0"
                                      " --depth-noise-px 0.2 --filter on --filter-edge 0.03")) ==
      nlohmann::json{{"occluders", "mesh"},
                     {"anti_alias", true},
                     {"band_sigmas", 0.0},
                     {"filter", "on"},
                     {"filter_m", 0.03},
                     {"noise", {{"focal_px", 424.0}, {"baseline_m", 0.05}, {"subpixel_px", 0.2}}}});
}

TEST_CASE("a known object that the depth image sees through, and a mesh that is not closed") {
  const test::TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  folder.write("sheet.obj", "v -0.05 0.1 0.03\nv 0.05 0.1 0.03\nv 0 0.1 0.1\nf 1 2 3\n");
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
                   "voxel_size_m: 0.01\n"
                   "known_objects:\n"
                   "  - {name: sheet, mesh: sheet.obj}\n"
                   "  - name: ghost\n"
                   "    box: {min_m: [-0.05, -0.09, 0.04], max_m: [0.05, -0.05, 0.1]}\n");
  const std::string plan = "plan '" + scene.string() + "' --workcell '" + cell.string() + "'";
  const auto result = run_vantage(plan + " --json");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.find("warning: object sheet: its mesh is not closed") != std::string::npos);
  const nlohmann::json json = result.json();
  CHECK_NOTHROW(check_schema({"plan.json", json}, plan_schema()));
  REQUIRE(json["warnings"].size() == 1);
  REQUIRE(json["conflicts"].size() == 1);  // the sheet is behind the box: nothing is known of it
  const nlohmann::json& ghost = json["conflicts"][0];
  CHECK(ghost["object"] == "ghost");
  CHECK(ghost["volume_m3"] > 0.9 * 0.1 * 0.04 * 0.06);
  CHECK(ghost["object_volume_m3"].get<double>() ==
        doctest::Approx(0.1 * 0.04 * 0.06).scale(0).epsilon(1e-6));
  const auto text = run_vantage(plan);
  CHECK(text.out.find("conflict   ghost: depth images see through 2") != std::string::npos);
  CHECK(text.out.find(" cm³ of its 240 cm³\n") != std::string::npos);
}

TEST_CASE("a deadline gives what is there by then, and exit code 5") {
  const test::TemporaryFolder folder;
  const std::string plan = "plan '" + test::write_scene(folder).string() + "'" + test::kSceneArea;
  const auto result = run_vantage(plan + " --json --deadline-ms 0");
  CHECK(result.exit_code == 5);
  CHECK(result.json()["partial"] == true);
  CHECK(result.json()["best"].is_null());
  CHECK(result.json()["shadow_regions"].is_null());
  CHECK_NOTHROW(check_schema({"plan.json", result.json()}, plan_schema()));
}

TEST_CASE("Ctrl-C gives exit code 130 and the partial plan") {
  const test::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const auto result = test::interrupt_vantage(
      "plan '" + test::write_scene(folder).string() +
          "' --work-area -0.5 -0.5 0.01 0.5 0.5 0.5 --voxel-size 0.002 -o '" + out + "'",
      1);
  CHECK(result.exit_code == 130);
  const bool before_any = result.out.find("stopped before") == 0;
  CHECK((before_any || result.out.find("\npartial ") != std::string::npos));
  const auto plan = nlohmann::json::parse(test::read_text(folder / "out/plan.json"));
  CHECK(plan["partial"] == true);
}

TEST_CASE("Ctrl-C while files are read ends the process at once, and nothing is written") {
  const test::TemporaryFolder folder;
  const std::filesystem::path scene = test::write_scene(folder);
  std::string numbers = "{\"7\": {\"cam_K\": [0";
  for (int i = 0; i < 1'900'000; ++i) numbers += ", 1.2345678901234567";  // seconds of reading
  folder.write("scene/scene_camera.json", numbers + "]}}");
  const auto result = test::interrupt_vantage("plan '" + scene.string() + "'" + test::kSceneArea +
                                                  " -o '" + (folder / "out").string() + "'",
                                              0);
  CAPTURE(result.err);
  CHECK(result.exit_code == 130);
  CHECK(result.err.find("interrupted") != std::string::npos);
  CHECK(result.err.find("nothing written") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("methods, further views and explanations, by the command line") {
  const test::TemporaryFolder folder;
  const std::string plan = "plan '" + test::write_scene(folder).string() + "'" + test::kSceneArea;
  const auto result = run_vantage(
      plan + " --method shadow --depth-power 3 --servo 2 --views 3 --explain 7,0 --json");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json json = result.json();
  CHECK_NOTHROW(check_schema({"plan.json", json}, plan_schema()));
  CHECK(json["method"] == "shadow");
  CHECK(json["config"]["depth_power"] == 3);
  CHECK(json["ranked"].size() == 10);
  CHECK(json["ranked"][0]["id"] == json["best"]["id"]);
  CHECK(json["views"][0]["T_world_cam"] == json["best"]["T_world_cam"]);
  CHECK(json["views"].size() <= 3);
  CHECK(json["config"]["polish"]["views"] == 2);
  const nlohmann::json &trace = json["best"]["servo_trace"], &steps = json["best"]["polish"];
  REQUIRE(!trace.empty());
  CHECK((trace.back()["move"] == "polish") == !steps.empty());
  CHECK(trace.size() <= (steps.empty() ? 3 : 4));
  if (!steps.empty()) CHECK(steps.back()["T_world_cam"] == json["best"]["T_world_cam"]);
  REQUIRE(json["explanations"].size() == 2);
  const nlohmann::json& explained = json["explanations"][0];
  CHECK(explained["id"] == 7);
  double revealed_m3 = 0;
  for (const auto& region : explained["regions"]) {
    revealed_m3 += region["revealed_m3"].get<double>();
  }
  CHECK(revealed_m3 == doctest::Approx(explained["newly_observed_volume_m3"].get<double>()));

  const auto text = run_vantage(plan + " --explain 7 --from 0.3 -0.5 0.4 --travel-weight 2");
  CHECK(text.exit_code == 0);
  CHECK(text.out.find("candidate 7: ") != std::string::npos);
  CHECK(text.out.find("after travel cost") != std::string::npos);

  const auto unknown = run_vantage(plan + " --explain 40");
  CHECK(unknown.exit_code == 3);
  CHECK(unknown.err.find("found candidate 40; expected 0 to 39") != std::string::npos);
  const auto raw = run_vantage(plan + " --polish 0 --method shadow --json").json();
  const auto polished = run_vantage(plan + " --method shadow --json").json();
  CHECK(raw["best"]["polish"].empty());
  CHECK(polished["best"]["score"] >= raw["best"]["score"]);
  CHECK(polished["candidates"].size() == raw["candidates"].size());
  CHECK(run_vantage(plan + " --polish -1").exit_code == 2);
  CHECK(run_vantage(plan + " --travel-weight 2").exit_code == 2);  // from where?
  CHECK(run_vantage(plan + " --method depth").exit_code == 2);
}

TEST_CASE("with nothing in reach: exit code 4, and every candidate says why") {
  const test::TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [-0.2, -0.1, 0.02], max_m: [0.2, 0.3, 0.22]}\n"
                   "reach: {base_m: [5, 0, 0], max_m: 0.9}\n");
  const auto result =
      run_vantage("plan '" + scene.string() + "' --workcell '" + cell.string() + "' --json");
  CHECK(result.exit_code == 4);
  const nlohmann::json json = result.json();
  CHECK(json["best"].is_null());
  CHECK(json["candidates"].size() == 40);
  for (const auto& candidate : json["candidates"]) {
    CHECK(candidate["feasible"] == false);
    CHECK(candidate["rejected"] == "out of reach");
  }
  const auto text = run_vantage("plan '" + scene.string() + "' --workcell '" + cell.string() + "'");
  CHECK(text.out.find(
            "no feasible view: every candidate was rejected\nrejected   40 out of reach\n") == 0);
}

TEST_CASE("the camera is a D435 that stays out of what is there and what is unseen, or a point") {
  const test::TemporaryFolder folder;
  // Just above the floor; beside the box's shadow, into which the left end of a D435 reaches;
  // free.
  const fs::path views =
      folder.write("views.yaml",
                   "views:\n"
                   "  - {eye_m: [0, 0.8, 0.03], target_m: [0, 0.1, 0.03]}\n"
                   "  - {eye_m: [0.145, 0.2, 0.05], target_m: [0.145, 1, 0.05]}\n"
                   "  - {eye_m: [0, 0.7, 0.4], target_m: [0, 0.1, 0.1]}\n");
  const std::string plan = "plan" + test::quoted(test::write_scene(folder)) + test::kSceneArea +
                           " --depth-range 0.03 3 --candidates" + test::quoted(views) + " --json";
  const auto reasons = [&](const std::string& options) {
    const auto result = run_vantage(plan + options);
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    const nlohmann::json json = result.json();
    nlohmann::json all = nlohmann::json::array();
    for (const auto& candidate : json["candidates"]) all.push_back(candidate["rejected"]);
    return all;
  };
  const nlohmann::json near = "too close to occupied volume", unseen = "body in unseen volume";
  CHECK(reasons("") == nlohmann::json{near, unseen, nullptr});
  CHECK(reasons(" --camera-body d435 --clearance 0") == nlohmann::json{nullptr, unseen, nullptr});
  CHECK(reasons(" --camera-body none") == nlohmann::json{nullptr, nullptr, nullptr});
  CHECK(reasons(" --camera-body none --clearance 0.04") == nlohmann::json{near, nullptr, nullptr});
  CHECK(run_vantage(plan + " --camera-body box").exit_code == 2);
}

TEST_CASE("a real Kinect recording: the suggested camera looks at the back of what stands there") {
  const auto scene = test::recording("osd_learn0");
  if (!scene) return;
  const auto result = run_vantage("plan '" + scene->string() +
                                  "' --work-area -0.25 -0.15 0.005 0.25 0.35 0.27 "
                                  "--voxel-size 0.005 --json");
  CHECK(result.exit_code == 0);
  const nlohmann::json plan = result.json();
  // The recording's camera stands at y = -0.49 m: the other side is y > 0.
  CHECK(plan["best"]["T_world_cam"]["translation_m"][1].get<double>() > 0.5);
  CHECK(revealed_share(plan) > 0.9);
  CHECK(plan["volumes_m3"]["occupied"].get<double>() > 0.0003);
}

TEST_CASE("pictures of several views, as drafts, are the same at any number of threads") {
  const test::TemporaryFolder folder;
  const std::string plan = "plan" + test::quoted(test::write_scene(folder)) + test::kSceneArea +
                           " --views 2 --least-gain-share 0 --value bound --filter off"
                           " --pictures --picture-quality draft --picture-width 500";
  const fs::path one = folder / "one", three = folder / "three";
  const auto result = run_vantage(plan + " --threads 1 -o" + test::quoted(one));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  REQUIRE(run_vantage(plan + " --threads 3 -o" + test::quoted(three)).exit_code == 0);
  for (const char* name : {"overview.png", "view.png", "view_2.png"}) {
    CAPTURE(name);
    CHECK(test::read_text(one / name) == test::read_text(three / name));
    CHECK(result.err.find(std::string("/") + name) != std::string::npos);
  }
  CHECK(std::distance(fs::directory_iterator(one), fs::directory_iterator()) == 4);
  CHECK(run_vantage(plan + "y -o" + test::quoted(one)).exit_code == 2);  // no such width
  CHECK(run_vantage("demo --picture-quality good -o" + test::quoted(one)).exit_code == 2);
}

TEST_CASE("what a deadline leaves no time for is drawn as a draft, with a message") {
  const test::TemporaryFolder folder;
  const auto result = run_vantage("demo --threads 1 --picture-width 2400 --deadline-ms 900 -o" +
                                  test::quoted(folder.path()));
  CAPTURE(result.err);
  CHECK((result.exit_code == 0 || result.exit_code == 5));
  CHECK(result.err.find("the deadline has passed: drawing") != std::string::npos);
  CHECK(read_color(folder / "overview.png").width == 2400);
}

}  // namespace vantage
