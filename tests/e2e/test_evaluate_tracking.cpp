#include <doctest/doctest.h>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "run_command.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::quoted;
using test::quoted_workcell;
using test::run_vantage;

std::string short_tracking(const std::string& options) {
  return "evaluate tracking" + quoted_workcell("clutter") +
         " --objects 3 --types brick,red_cube --sequences 1 --instants 24 --moves 1 "
         "--depth-width 0 --filters none " +
         options;
}

}  // namespace

TEST_CASE("evaluate tracking writes tracking.json, the same at any number of threads") {
  const test::TemporaryFolder folder;
  const auto one = run_vantage(short_tracking("--threads 1 --json -o" + quoted(folder / "out")));
  CAPTURE(one.err);
  REQUIRE(one.exit_code == 0);
  const json tracking = one.json();
  CHECK_NOTHROW(check_schema(Document{"tracking.json", tracking}, tracking_schema()));
  CHECK(tracking == json::parse(test::read_text(folder / "out/tracking.json")));
  REQUIRE(tracking["trackers"].size() == 2);
  CHECK(tracking["trackers"][0]["name"] == "snapshots");
  CHECK(tracking["trackers"][0]["scores"]["events"]["moves"] == 1);
  CHECK(tracking["trackers"][1]["scores"]["det_a"].get<double>() > 0.5);
  CHECK(run_vantage(short_tracking("--threads 3 --json")).json() == tracking);
  CHECK(run_vantage(short_tracking("--seed 2 --json")).json()["trackers"] != tracking["trackers"]);
}

TEST_CASE("evaluate tracking prints its goals, and which are reached") {
  const auto result = run_vantage(short_tracking(""));
  REQUIRE(result.exit_code == 0);
  for (const char* part : {"HOTA", "IDF1", "Goals, tracker none", "NEES in its 95 % interval"}) {
    CAPTURE(part);
    CHECK(result.out.find(part) != std::string::npos);
  }
}

TEST_CASE("evaluate tracking says what it cannot do") {
  const auto refused = [](const std::string& options, int exit_code, const char* reason) {
    CAPTURE(options);
    const auto result = run_vantage(short_tracking(options));
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    CHECK(result.err.find(reason) != std::string::npos);
    CHECK(result.out.empty());
  };
  refused("--drop 2", 2, "--drop");
  refused("--carry-instants 24", 3, "instants");
  CHECK(
      run_vantage("evaluate tracking" + quoted_workcell("clutter") + " --types lorry").exit_code ==
      3);
}

TEST_CASE("evaluate tracking, interrupted, has the sequences that are complete") {
  const auto result = test::interrupt_vantage(
      "evaluate tracking" + quoted_workcell("clutter") +
          " --objects 2 --types brick --sequences 100000 --instants 12 --moves 0 --depth-width 0 "
          "--filters none --json",
      2);
  CHECK(result.exit_code == 130);
  if (!result.out.empty()) CHECK(result.json()["partial"] == true);
}

}  // namespace vantage
