#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "run_command.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::quoted;
using test::run_vantage;
namespace fs = std::filesystem;

/// Clutter without its room, six objects, of which one is moved in plain sight.
void record_sequence(const fs::path& data) {
  const auto result = run_vantage(
      "simulate" + test::quoted_workcell("clutter") + " -o" + quoted(data) +
      " --objects 6 --types red_cube,brick --seed 3 --samples 2 --instants 14 --period-s 0.2"
      " --moves 1 --carry-instants 2");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
}

test::CommandResult track(const fs::path& data, const fs::path& out, const std::string& more = "") {
  return run_vantage("track" + quoted(data) + " --workcell" + quoted(data / "workcell.yaml") +
                     (out.empty() ? "" : " -o" + quoted(out)) + " --json " + more);
}

double distance_m(const json& a, const json& b) {
  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    squared +=
        std::pow(a["translation_m"][i].get<double>() - b["translation_m"][i].get<double>(), 2);
  }
  return std::sqrt(squared);
}

std::vector<json> lines_of(const fs::path& file) {
  std::vector<json> lines;
  std::istringstream text(test::read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  return lines;
}

}  // namespace

TEST_CASE("track: a recorded sequence has the events and the places that are true of it") {
  const test::TemporaryFolder folder;
  const fs::path data = folder / "sequence", out = folder / "out";
  record_sequence(data);
  const auto result = track(data, out);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json truth = json::parse(test::read_text(data / "sequence.json"));
  const std::vector<json> events = lines_of(out / "events.jsonl");
  REQUIRE(truth["events"].size() == 1);
  const json& moved = truth["events"][0];
  std::size_t moves = 0;
  for (const json& event : events) {
    CAPTURE(event.dump());
    CHECK(event["event"] != "disappeared");
    if (event["event"] != "moved") continue;
    ++moves;
    CHECK(distance_m(event["from"], moved["from"]) < 0.005);
    CHECK(distance_m(event["to"], moved["to"]) < 0.005);
    CHECK(event["time_s"].get<double>() - moved["to_s"].get<double>() < 0.61);
  }
  CHECK(moves == 1);

  const json world = json::parse(test::read_text(out / "000013" / "world.json"));
  CHECK(world["time_s"].get<double>() == doctest::Approx(2.6));
  for (const json& object : world["objects"]) {
    if (object["probability"].get<double>() < 0.5) continue;
    double nearest = 1;
    for (const json& there : truth["instants"][13]["objects"]) {
      nearest = std::min(nearest, distance_m(object["T_world_object"], there["T_world_object"]));
    }
    CAPTURE(object.dump());
    CHECK(nearest < 0.005);
  }
  CHECK(fs::exists(out / "000013" / "overlay_000000.png"));

  const auto plan = run_vantage("plan" + quoted(data / "000013") + " --workcell" +
                                quoted(data / "workcell.yaml") + " --objects" +
                                quoted(out / "000013" / "world.json") +
                                " --method voxel --voxel-size 0.02 --json");
  CAPTURE(plan.err);
  CHECK((plan.exit_code == 0 || plan.exit_code == 4));  // 4: no view reveals anything
  CHECK(plan.json()["inputs"].dump().find("world.json") != std::string::npos);
}

TEST_CASE("track: what is no sequence is refused with what was expected") {
  const test::TemporaryFolder folder;
  const fs::path scene = test::write_scene(folder);
  const auto single =
      run_vantage("track" + quoted(scene) + " --workcell" + test::quoted_workcell("clutter"));
  CHECK(single.exit_code == 3);
  CHECK(single.err.find("single BOP scene") != std::string::npos);

  const fs::path empty = folder / "empty";
  fs::create_directory(empty);
  const auto none =
      run_vantage("track" + quoted(empty) + " --workcell" + test::quoted_workcell("clutter"));
  CHECK(none.exit_code == 3);
  CHECK(none.err.find("no sequence.json") != std::string::npos);

  write_file(empty / "sequence.json", R"({"instants": [{"folder": "a", "time_s": 0}]})");
  const auto missing =
      run_vantage("track" + quoted(empty) + " --workcell" + test::quoted_workcell("clutter"));
  CHECK(missing.exit_code == 3);
  CHECK(missing.err.find("instants[0].folder") != std::string::npos);

  fs::create_directory(empty / "a");
  fs::copy(scene, empty / "a", fs::copy_options::recursive);
  write_file(empty / "sequence.json",
             R"({"instants": [{"folder": "a", "time_s": 1}, {"folder": "a", "time_s": 0.5}]})");
  const auto back =
      run_vantage("track" + quoted(empty) + " --workcell" + test::quoted_workcell("clutter"));
  CHECK(back.exit_code == 3);
  CHECK(back.err.find("instants[1].time_s") != std::string::npos);
}

}  // namespace vantage
