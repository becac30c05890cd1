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

TEST_CASE("evaluate shadow-filters: the default offset with an opening beats no filter") {
  const std::string command = "evaluate shadow-filters" + quoted_workcell("wall", ":side") +
                              quoted_workcell("corridor", ":left,right") +
                              " --offsets 0,3 --openings 0,2 --least-cm3 0";
  const auto text = run_vantage(command);
  CAPTURE(text.err);
  REQUIRE(text.exit_code == 0);
  for (const char* part : {"means over 2 scenes, voxels of 4.7 mm", "wall:side+noisy", "best"}) {
    CAPTURE(part);
    CHECK(text.out.find(part) != std::string::npos);
  }
  const json report = run_vantage(command + " --json --threads 1").json();
  CHECK_NOTHROW(check_schema({"report", report}, shadow_filters_schema()));
  CHECK(run_vantage(command + " --json --threads 3").json() == report);
  CHECK(report["config"]["offsets_sigmas"] == json({0, 3}));
  CHECK(report["config"]["openings_voxels"] == json({0, 2}));
  CHECK(report["config"]["classified"] == false);
  CHECK(report["config"]["voxel_size_m"] == 0.0047);
  REQUIRE(report["filters"].size() == 4);
  CHECK(report["best"] == 3);
  const auto f1 = [&](std::size_t filter) {
    return report["filters"][filter]["mean"]["f1"].get<double>();
  };
  CHECK(f1(1) > f1(0) + 0.02);   // the opening alone
  CHECK(f1(2) > f1(0) + 0.002);  // the offset alone
  CHECK(f1(3) > f1(0) + 0.03);
  for (const json& one : report["scenes"]) {
    CHECK(one["filters"][3]["recall"].get<double>() > 0.9);
    CHECK(one["filters"][3]["false_m3"].get<double>() <
          0.5 * one["filters"][0]["false_m3"].get<double>());
  }
}

TEST_CASE("evaluate shadow-filters: depth without noise leaves little false shadow") {
  const json ideal =
      run_vantage("evaluate shadow-filters" + quoted_workcell("two_pillars", "+ideal") +
                  " --offsets 0 --openings 0 --least-cm3 0 --step 1 --json")
          .json();
  const json& score = ideal["scenes"][0]["filters"][0];
  CHECK(score["recall"].get<double>() > 0.999);
  CHECK(score["precision"].get<double>() > 0.999);
}

TEST_CASE("evaluate shadow-filters refuses what it cannot evaluate") {
  const auto refused = [](const std::string& options, int exit_code, const char* reason) {
    CAPTURE(options);
    const auto result = run_vantage("evaluate shadow-filters" + options);
    CHECK(result.exit_code == exit_code);
    CAPTURE(result.err);
    CHECK(result.err.find(reason) != std::string::npos);
    CHECK(result.out.empty());
  };
  refused("", 2, "scenes");
  refused(quoted_workcell("wall", "+none"), 3, "has no depth image");
  refused(quoted_workcell("wall", ":back"), 3, "it has no camera \"back\"");
  refused(quoted_workcell("wall") + " --offsets -1", 2, "--offsets");
  refused(quoted_workcell("wall") + " --openings 65", 2, "--openings");
  refused(quoted_workcell("wall") + " --step 0", 2, "--step");
  refused(quoted_workcell("wall") + " --holes ignore", 2, "--holes");
  for (const char* option : {"--offsets 1", "--step 2", "--holes fill"}) {
    refused(quoted_workcell("wall") + " --classified " + option, 2,
            "does nothing with --classified");
  }
}

}  // namespace vantage
