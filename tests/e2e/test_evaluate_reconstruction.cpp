#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "python_check.hpp"
#include "run_command.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::make_dataset;
using test::quoted;
using test::run_vantage;
namespace fs = std::filesystem;

std::string evaluation(const fs::path& data, const std::string& options) {
  return "evaluate reconstruction" + quoted(data) + " --workcell" + quoted(data / "workcell.yaml") +
         " " + options;
}

test::CommandResult evaluate(const fs::path& data, const std::string& options) {
  return run_vantage(evaluation(data, options));
}

/// What a detector of whole poses writes of an object of scene_gt.json, shifted in the camera's
/// frame.
json pose_feature(const std::string& image, const json& object, const Eigen::Vector3d& shift_m) {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d at_m;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = object["cam_R_m2c"][i];
  for (int i = 0; i < 3; ++i) at_m[i] = object["cam_t_m2c"][i].get<double>() / 1000;
  const Eigen::Quaterniond q(rotation);
  at_m += shift_m;
  return {{"image", std::stoi(image)},
          {"type", "pose"},
          {"value", "obj_00000" + std::to_string(object["obj_id"].get<int>())},
          {"T_cam_feature",
           {{"rotation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}},
            {"translation_m", {at_m.x(), at_m.y(), at_m.z()}}}}};
}

const json& method(const json& report, const std::string& name) {
  for (const json& one : report["methods"]) {
    if (one["method"] == name) return one;
  }
  FAIL("no such method");
  return report;
}

}  // namespace

TEST_CASE("castle: errors are as NumPy computes them from the files, and fall with more cameras") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  make_dataset("castle", data);
  const auto result = evaluate(data, "--cameras board --json -o" + quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json report = result.json();
  CHECK_NOTHROW(check_schema({"reconstruction.json", report}, evaluation_schema()));
  CHECK(json::parse(test::read_text(folder / "out/reconstruction.json")) == report);
  CHECK(test::read_text(folder / "out/reconstruction.svg").starts_with("<svg"));
  test::check_in_python("check_reconstruction.py", folder.path());

  CHECK(report["subsets"] == 502);
  CHECK(report["touching_corner_pairs"] == 26);
  const json &svd = method(report, "svd")["by_cameras"], &pnp = method(report, "pnp")["by_cameras"];
  REQUIRE(pnp.size() == 8);
  const auto error = [](const json& sizes, std::size_t i) {
    return sizes[i]["translation_mm"]["mean"].get<double>();
  };
  for (std::size_t i = 0; i < 8; ++i) {
    CAPTURE(i);
    CHECK(error(pnp, i) < error(svd, i));
    if (i > 0) CHECK(error(pnp, i) < error(pnp, i - 1));
  }
  CHECK(method(report, "pnp")["all"]["recall"].get<double>() == 1);
  CHECK(method(report, "pnp")["all"]["precision"] == 1.0);
}

TEST_CASE("clutter: several instances of a type, and errors as NumPy computes them") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  make_dataset("clutter", data);
  const auto result = evaluate(data, "--sizes 1- --json -o" + quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  test::check_in_python("check_reconstruction.py", folder.path());
  const json report = result.json();
  const json& pnp = method(report, "pnp")["by_cameras"][2];
  CHECK(pnp["cameras"] == 3);
  CHECK(pnp["true_objects"].get<int>() > 15);
  CHECK(pnp["recall"].get<double>() > 0.9);
  CHECK(pnp["precision"].get<double>() > 0.9);
  CHECK(method(report, "svd")["all"]["recall"].get<double>() < 0.5);  // knows one of each type
}

TEST_CASE("the same bytes at any number of threads, others with another seed") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  make_dataset("castle", data);
  const std::string options =
      "--images 0,4,8 --noise-px 0.3 --drop 0.2 --wrong-ids 0.05 --trials 3 --json --threads ";
  const auto one = evaluate(data, options + "1"), three = evaluate(data, options + "3");
  CAPTURE(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out == three.out);
  const auto other = evaluate(data, options + "3 --seed 2");
  CHECK(other.json()["runs"] != one.json()["runs"]);
  CHECK(one.json()["runs"].size() == 4 * 3);
}

TEST_CASE("a dataset with BOP's models and truth needs no simulated cell") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  make_dataset("castle", data);
  const fs::path cell =
      folder.write("cell.yaml",
                   "work_area: {min_m: [-0.25, -0.175, 0], max_m: [0.25, 0.175, 0.2]}\n"
                   "knowledge_base: [data/models]\n");
  std::string seen;  // by a detector that is 2 mm off along every camera's axis
  const json truth = json::parse(test::read_text(data / "scene_gt.json"));
  for (const char* image : {"0", "4"}) {
    for (const json& object : truth[image]) {
      seen += pose_feature(image, object, Eigen::Vector3d(0, 0, 0.002)).dump() + "\n";
    }
  }
  const fs::path features = folder.write("seen.jsonl", seen);
  const auto result = run_vantage("evaluate reconstruction" + quoted(data) + " --workcell" +
                                  quoted(cell) + " --images 0,4 --sizes 1 --methods voting --json" +
                                  " --no-markers --features" + quoted(features));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json report = result.json();
  CHECK(report["true_objects"].size() == 5);  // named by both images, but the same
  const json& one_camera = method(report, "voting")["by_cameras"][0];
  CHECK(one_camera["recall"] == 1.0);
  CHECK(std::abs(one_camera["translation_mm"]["mean"].get<double>() - 2) < 0.1);
}

TEST_CASE("what cannot be evaluated is refused with the reason") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  make_dataset("castle", data);
  const auto refused = [&](const std::string& options, int exit_code, const char* reason) {
    CAPTURE(options);
    const auto result = evaluate(data, options);
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    CHECK(result.err.find(reason) != std::string::npos);
  };
  refused("--sizes many", 3, "--sizes: found 'many'; expected numbers of cameras like 3");
  refused("--sizes 2-12", 3, "found subsets of 2 to 12 cameras; expected 1 to 9");
  refused("--trials 2000 --drop 0.1", 6, "2000 trials of 502 subsets are more than 1000000 runs");
  refused("--methods svd,magic", 2, "magic");
  refused("--drop 1.5", 2, "--drop");
  refused("--trials 3", 2, "--trials: does nothing without --noise-px, --drop or --wrong-ids");
  refused("--seed 3 --drop 0", 2, "--seed: does nothing without");
  refused("--methods svd --no-ambiguous", 2, "--no-ambiguous: does nothing without pnp");
  refused("--images 0 --sizes 1 --subsets covering --wrong-ids 0.1 --trials 0", 2, "--trials");

  const fs::path empty =
      folder.write("empty.yaml",
                   "work_area: {min_m: [-0.25, -0.175, 0], max_m: [0.25, 0.175, 0.2]}\n"
                   "knowledge_base: [data/models]\n");
  fs::remove(data / "scene_gt.json");
  const auto unknown =
      run_vantage("evaluate reconstruction" + quoted(data) + " --workcell" + quoted(empty));
  CHECK(unknown.exit_code == 3);
  CHECK(unknown.err.find("there is no ground truth") != std::string::npos);
}

TEST_CASE("Ctrl-C ends an evaluation with 130, and writes nothing") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "data";
  make_dataset("castle", data);
  const auto result = test::interrupt_vantage(
      evaluation(data, "--trials 1000 --drop 0.1 -o" + quoted(folder / "out")), 1);
  CHECK(result.exit_code == 130);
  CHECK(result.out.empty());
  CHECK_FALSE(fs::exists(folder / "out"));
}

}  // namespace vantage
