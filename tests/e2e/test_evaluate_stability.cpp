#include <doctest/doctest.h>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "run_command.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using test::quoted_workcell;
using test::run_vantage;

}  // namespace

TEST_CASE(
    "evaluate stability: right verdicts, poses nearer to the truth, the same at any number of "
    "threads") {
  const std::string command = "evaluate stability" + quoted_workcell("clutter") +
                              " --stacks 24 --scenes 2 --objects 8 --json";
  const auto result = run_vantage(command + " --threads 1");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json report = result.json();
  CHECK_NOTHROW(check_schema({"report", report}, stability_schema()));
  CHECK(run_vantage(command + " --threads 3").json() == report);
  CHECK(report["config"]["stacks"] == 24);
  const json& all = report["stacks"]["all"];
  CHECK(all["judged"].get<int>() >= 12);
  // Of those that are pushed aside, some stay within what the poses leave open.
  CHECK(all["right"].get<double>() >= 0.7 * all["judged"].get<double>());
  for (const char* fault : {"none", "removed"}) {
    CHECK(report["stacks"][fault]["right"] == report["stacks"][fault]["judged"]);
  }
  for (const char* fault : {"none", "removed", "shifted"}) {
    CAPTURE(fault);
    CHECK(report["stacks"][fault]["judged"].get<int>() > 0);
  }
  for (const char* where : {"in_stacks", "in_scenes"}) {
    CAPTURE(where);
    const json& resting = report["at_rest"][where];
    CHECK(resting["flagged"] == 0);
    CHECK(resting["pulled"].get<int>() > 0);
    for (const char* what : {"translation_mm", "rotation_deg"}) {
      CHECK(resting["after"][what].get<double>() < resting["before"][what].get<double>());
    }
  }
}

TEST_CASE("evaluate stability says what it cannot do") {
  const auto refused = [](const std::string& options, int exit_code, const char* reason) {
    CAPTURE(options);
    const auto result = run_vantage("evaluate stability" + options);
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    CHECK(result.err.find(reason) != std::string::npos);
    CHECK(result.out.empty());
  };
  refused("", 2, "workcell");
  refused(quoted_workcell("clutter") + " --stacks -1", 2, "--stacks");
  refused(quoted_workcell("clutter") + " --types lorry", 3, "lorry");
}

}  // namespace vantage
