#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "run_command.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::make_dataset;
using test::quoted;
using test::run_vantage;
namespace fs = std::filesystem;

test::CommandResult reconstruct(const fs::path& data, const std::string& options) {
  return run_vantage("reconstruct" + quoted(data) + " --workcell" + quoted(data / "workcell.yaml") +
                     " " + options);
}

/// Takes the cameras' poses out of a dataset: they have to be found by the board.
void forget_cameras(const fs::path& data) {
  json cameras = json::parse(test::read_text(data / "scene_camera.json"));
  for (auto& [id, camera] : cameras.items()) camera.erase("cam_R_w2c"), camera.erase("cam_t_w2c");
  write_file(data / "scene_camera.json", cameras.dump());
}

/// The largest distance, in millimetres, of an object from its truth in any camera's frame.
double worst_offset_mm(const json& world, const fs::path& data) {
  const json truth = json::parse(test::read_text(data / "scene_gt.json"));
  double worst = 0;
  for (const auto& [image, objects] : world["bop"].items()) {
    CHECK(objects.size() == truth[image].size());
    for (const json& object : objects) {
      double nearest = 1e9;
      for (const json& there : truth[image]) {
        if (there["obj_id"] != object["obj_id"]) continue;
        double squared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          squared += std::pow(
              there["cam_t_m2c"][i].get<double>() - object["cam_t_m2c"][i].get<double>(), 2);
        }
        nearest = std::min(nearest, std::sqrt(squared));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("a simulated cell is reconstructed by every method, its cameras found by the board") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "castle";
  make_dataset("castle", data, "--ideal-depth --distortion -0.1 0.03 0.001 -0.0005 0");
  forget_cameras(data);
  for (const char* method : {"svd", "pnp", "voting"}) {
    CAPTURE(method);
    const auto result = reconstruct(data, std::string("--json --method ") + method);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    const json world = result.json();
    CHECK(world["objects"].size() == 5);
    CHECK(world["unexplained"].empty());
    for (const json& camera : world["cameras"]) CHECK(camera["located_by"] == "board");
    CHECK(worst_offset_mm(world, data) < (method == std::string("svd") ? 4.0 : 1.0));
  }
}

TEST_CASE("through fisheye lenses, objects are found as through others") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "castle";
  make_dataset("castle", data, "--ideal-depth --fisheye 0.08 -0.02 0.01 -0.003");
  forget_cameras(data);
  const auto result = reconstruct(data, "--json -o" + quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json world = result.json();
  CHECK(world["objects"].size() == 5);
  for (const json& camera : world["cameras"]) CHECK(camera["lens_model"] == "fisheye");
  CHECK(worst_offset_mm(world, data) < 1.0);
  CHECK(fs::exists(folder / "out/overlay_000000.png"));
}

TEST_CASE("a board locates cameras without any knowledge base") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "wall";
  make_dataset("wall", data);
  const fs::path cell = folder.write(
      "board.yaml", "work_area: {min_m: [-0.3, -0.3, 0], max_m: [0.3, 0.3, 0.3]}\nboard: " +
                        (test::assets() / "workcells/boards/board_50x35.yaml").string() + "\n");
  const auto board = run_vantage("reconstruct" + quoted(data) +
                                 " --cameras board --json --workcell" + quoted(cell));
  CAPTURE(board.err);
  REQUIRE(board.exit_code == 0);
  const json world = board.json();
  CHECK(world["objects"].empty());
  CHECK_FALSE(world["cameras"].empty());
  const json truth = json::parse(test::read_text(data / "scene_camera.json"));
  forget_cameras(data);
  const auto plan =
      run_vantage("plan" + quoted(data) + " --voxel-size 0.02 --json --workcell" + quoted(cell));
  CAPTURE(plan.err);
  CHECK(plan.exit_code == 0);
}

TEST_CASE("objects that are given and objects that are recognised stand beside one another") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "wall";
  make_dataset("wall", data);
  const auto objects = [&](const std::string& how) {
    const auto result = run_vantage("plan" + quoted(data) + " --voxel-size 0.02 --json --workcell" +
                                    quoted(data / "workcell.yaml") + " --objects " + how);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    return result.json();
  };
  // Everything in this cell is given and recognised: none of it is there twice.
  const double given = objects("given")["volumes_m3"]["occupied"];
  const double both = objects("given+pnp")["volumes_m3"]["occupied"];
  CHECK(std::abs(both - given) < 0.1 * given);
}

TEST_CASE("a plan takes the world that was reconstructed, or reconstructs it itself") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "wall", out = folder / "out";
  make_dataset("wall", data);
  const auto found = reconstruct(data, "-o" + quoted(out));
  CAPTURE(found.err);
  REQUIRE(found.exit_code == 0);
  CHECK(fs::exists(out / "world.json"));
  CHECK(fs::exists(out / "overlay_000000.png"));

  const auto plan = [&](const std::string& objects) {
    const auto result = run_vantage("plan" + quoted(data) + " --workcell" +
                                    quoted(data / "workcell.yaml") + " --json --objects" + objects);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    return result.json();
  };
  json from_file = plan(quoted(out / "world.json")), itself = plan(" pnp"), given = plan(" given");
  CHECK(from_file["best"] == itself["best"]);
  CHECK(from_file["volumes_m3"] == itself["volumes_m3"]);
  const double shadow = given["volumes_m3"]["shadow"];
  CHECK(std::abs(itself["volumes_m3"]["shadow"].get<double>() - shadow) < 0.05 * shadow);
}

TEST_CASE("a printed board on photographs: one half is found where the other half says") {
  const auto folder = test::recording("charuco");
  if (!folder) return;
  const auto result = run_vantage("reconstruct" + quoted(*folder) + " --workcell" +
                                  test::quoted_workcell("charuco") + " --calibration" +
                                  quoted(*folder / "camera.yml") + " --json");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json world = result.json();
  REQUIRE(world["cameras"].size() == 3);
  for (const json& camera : world["cameras"]) {
    CHECK(camera["board_markers"] == 9);
    CHECK(camera["rms_px"].get<double>() < 0.57);
  }
  REQUIRE(world["objects"].size() == 1);
  const json& pose = world["objects"][0]["T_world_object"];
  const json &q = pose["rotation"], &t = pose["translation_m"];
  const Eigen::Quaterniond turn(q["w"], q["x"], q["y"], q["z"]);
  const Eigen::Vector3d shift(t[0], t[1], t[2]), middle(0, -0.05, 0);  // of its markers
  const double mm = 1000 * (turn * middle + shift - middle).norm();
  const double degrees = 2 * std::acos(std::min(1.0, std::abs(turn.w()))) * 180 / EIGEN_PI;
  MESSAGE(mm << " mm, " << degrees << " degrees; at the board's middle " << 1000 * shift.norm());
  CHECK(mm < 0.63);
  CHECK(degrees < 0.62);
  CHECK(world["objects"][0]["support"].size() == 20);
}

TEST_CASE("features come from other detectors, too") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "wall";
  make_dataset("wall", data);
  // A detector that has the whole pose: the knowledge base's models, read as BOP has them.
  const json truth = json::parse(test::read_text(data / "scene_gt.json"));
  std::string lines;
  for (const auto& [image, objects] : truth.items()) {
    for (const json& object : objects) {
      const auto& r = object["cam_R_m2c"];
      Eigen::Matrix3d rotation;
      for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = r[std::size_t(i)];
      const Eigen::Quaterniond q(rotation);
      json line{{"image", std::stoi(image)},
                {"type", "pose"},
                {"value", "obj_00000" + std::to_string(object["obj_id"].get<int>())},
                {"T_cam_feature",
                 {{"rotation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}},
                  {"translation_m", json::array()}}}};
      for (const json& mm : object["cam_t_m2c"]) {
        line["T_cam_feature"]["translation_m"].push_back(mm.get<double>() / 1000);
      }
      lines += line.dump() + "\n";
    }
  }
  const fs::path features = folder.write("features.jsonl", lines);
  const fs::path cell = folder.write("cell.yaml",
                                     "work_area: {min_m: [-0.2, -0.2, 0], max_m: [0.2, 0.2, 0.2]}\n"
                                     "knowledge_base: wall/models\n");
  for (const char* method : {"pnp", "voting"}) {
    CAPTURE(method);
    const auto result =
        run_vantage("reconstruct" + quoted(data) + " --workcell" + quoted(cell) + " --features" +
                    quoted(features) + " --no-markers --json --method " + method);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(result.json()["objects"].size() == truth["0"].size());
    CHECK(worst_offset_mm(result.json(), data) < 0.01);
  }
}

TEST_CASE("reconstruct says what is missing, with exit code 3") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "wall";
  make_dataset("wall", data);
  const auto refused = [&](const std::string& arguments, const char* part) {
    const auto result = run_vantage("reconstruct" + quoted(data) + arguments);
    CAPTURE(arguments);
    CAPTURE(result.err);
    CHECK(result.exit_code == 3);
    CHECK(result.err.find(part) != std::string::npos);
  };
  const std::string area = "work_area: {min_m: [-0.2, -0.2, 0], max_m: [0.2, 0.2, 0.2]}\n";
  const std::string own = " --workcell" + quoted(data / "workcell.yaml");
  refused(" --workcell" + quoted(folder.write("a.yaml", area)), "knowledge_base");
  refused(own + " --features" + quoted(folder / "nothing.jsonl"), "nothing.jsonl");
  refused(own + " --calibration" + quoted(folder / "nothing.yml"), "nothing.yml");
  refused(own + " --features" + quoted(folder.write("f.jsonl", "{\"image\": 0}\n")), "f.jsonl:1");
  refused(own + " --features" +
              quoted(folder.write("g.jsonl",
                                  "{\"image\": 99, \"type\": \"color\", \"value\": "
                                  "\"red\", \"point_m\": [0, 0, 1]}\n")),
          "image 99");
  forget_cameras(data);
  const fs::path no_board = folder.write("b.yaml", area + "knowledge_base: wall/models\n");
  refused(" --workcell" + quoted(no_board) + " --features" + quoted(folder.write("h.jsonl", "")),
          "cam_R_w2c");
  CHECK(run_vantage("reconstruct" + quoted(data) + own + " --method best").exit_code == 2);
  for (const auto& [options, needs] : {std::pair(" --no-pictures", "--output"),
                                       std::pair(" --method svd --no-ambiguous", "--method pnp")}) {
    const auto unused = run_vantage("reconstruct" + quoted(data) + own + options);
    CAPTURE(unused.err);
    CHECK(unused.exit_code == 2);
    CHECK(unused.err.find(needs) != std::string::npos);
  }
  fs::create_directories(folder / "photographs");
  const auto photographs = run_vantage("reconstruct" + quoted(folder / "photographs") + own);
  CHECK(photographs.exit_code == 3);
  CHECK(photographs.err.find("--calibration") != std::string::npos);
  const auto plan = run_vantage("plan" + quoted(data) + own + " --objects nothing.json");
  CHECK(plan.exit_code == 3);
  CHECK(plan.err.find("nothing.json; expected given, pnp") != std::string::npos);
}

}  // namespace vantage
