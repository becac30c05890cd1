#include <doctest/doctest.h>

#include <set>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "run_command.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::quoted;
using test::quoted_workcell;
using test::run_vantage;
namespace fs = std::filesystem;

const json& of_method(const json& list, const std::string& method) {
  for (const json& one : list) {
    if (one["method"] == method) return one;
  }
  FAIL("no such method");
  return list;
}

}  // namespace

TEST_CASE("evaluate planning: tables, planning.json, charts and a page") {
  const test::TemporaryFolder folder;
  const auto result =
      run_vantage("evaluate planning" + quoted_workcell("wall", ":front") +
                  quoted_workcell("foreign_objects", "+ideal") +
                  " --candidates production --methods shadowD6 --servo 2 --voxel-size 0.02"
                  " --no-pictures -o" +
                  quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  for (const char* part :
       {"wall:front (thesis: Wall, side)", "foreign_objects:front+ideal",
        "Methods compared: production set, 40 views, servo 2, 2 polished", "thesis: table 9.1"}) {
    CAPTURE(part);
    CHECK(result.out.find(part) != std::string::npos);
  }
  const json report = json::parse(test::read_text(folder / "out/planning.json"));
  CHECK_NOTHROW(check_schema({"planning.json", report}, planning_schema()));
  REQUIRE(report["scenes"].size() == 2);
  CHECK(report["inputs"].size() >= 3);  // the cells, the types, the board
  for (const json& one : report["scenes"]) {
    const json& methods = one["sets"][0]["methods"];
    CHECK(of_method(methods, "voxel")["pick"]["vox_ratio"] == 1.0);
    CHECK(of_method(methods, "shadowD6")["pick"]["vox_ratio"].get<double>() > 0.5);
    CHECK(of_method(methods, "shadowD6")["pick"]["regret_m3"].get<double>() >= 0);
  }
  CHECK(test::read_text(folder / "out/planning_production.svg").starts_with("<svg"));
  CHECK(test::read_text(folder / "out/planning.html").starts_with("<!DOCTYPE html>"));
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder / "out")) {
    files.insert(entry.path().filename());
  }
  CHECK(files ==
        std::set<std::string>{"planning.html", "planning.json", "planning_production.svg"});
}

TEST_CASE("evaluate planning's page shows what is picked") {
  const test::TemporaryFolder folder;
  const auto result =
      run_vantage("evaluate planning" + quoted_workcell("wall", ":front") +
                  " --candidates production --methods voxel --servo 0 -o" + quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const std::string page = test::read_text(folder / "out/planning.html");
  CHECK(page.find("data:image/jpeg;base64,/9j/") != std::string::npos);
}

TEST_CASE("evaluate planning: but for the times, the same bytes at any number of threads") {
  const std::string command = "evaluate planning" + quoted_workcell("corridor", ":left,right") +
                              " --candidates production --servo 1 --voxel-size 0.02 --json";
  json one = run_vantage(command + " --threads 1").json();
  json three = run_vantage(command + " --threads 3 --repeat 2").json();
  CHECK(one["timing"]["threads"] == 1);
  CHECK(three["timing"]["scenes"][0]["runs"][0]["run_times_s"].size() == 2);
  one.erase("timing");
  three.erase("timing");
  CHECK(one == three);
}

TEST_CASE("evaluate planning refuses what it cannot evaluate, and writes nothing") {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& options, int exit_code, const char* reason) {
    CAPTURE(options);
    const auto result = run_vantage("evaluate planning" + options + " -o" + quoted(folder / "out"));
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    CHECK(result.err.find(reason) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  refused("", 2, "scenes");
  refused(quoted_workcell("wall", ":back"), 3, "it has no camera \"back\"");
  refused(quoted_workcell("wall") + quoted_workcell("nowhere"), 3, "nowhere.yaml");
  refused(quoted_workcell("wall") + " --methods magic", 3, "found 'magic'");
  refused(quoted_workcell("wall") + " --candidates some", 2, "some");
  refused(quoted_workcell("wall") + " --depth deep", 2, "deep");
  refused(quoted_workcell("wall", "+deep"), 3, "found \"deep\"");
  refused(quoted_workcell("wall") + " --servo 101", 2, "--servo");
  refused(quoted_workcell("wall") + " --servo 0 --servo-width 64", 2,
          "--servo-width: does nothing without --servo N");
  refused(quoted_workcell("wall") + " --filter off --filter-edge 0.1", 2, "--filter-edge");
}

TEST_CASE("Ctrl-C before the first scene is evaluated ends it with 130, and writes nothing") {
  const test::TemporaryFolder folder;
  const auto result =
      test::interrupt_vantage("evaluate planning" + quoted_workcell("wall", ":front") +
                                  " --repeat 1000 -o" + quoted(folder / "out"),
                              0.5);
  CHECK(result.exit_code == 130);
  CHECK(result.out.empty());
  CHECK_FALSE(fs::exists(folder / "out"));
}

}  // namespace vantage
