#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "run_command.hpp"

namespace vantage {

using test::run_vantage;

TEST_CASE(
    "evaluate expected-gain: picks against what they gain, the same at any number of threads") {
  const std::string command =
      "evaluate expected-gain --random 2 --seed 3 --methods expected,bound --json --threads ";
  const auto one = run_vantage(command + "1"), three = run_vantage(command + "3");
  CAPTURE(one.err);
  REQUIRE(one.exit_code == 0);
  CHECK(one.out == three.out);
  const auto report = one.json();
  REQUIRE(report["cells"].size() == 2);
  REQUIRE(report["methods"].size() == 2);
  for (const auto& cell : report["cells"]) {
    REQUIRE(cell["views"].size() == 2);
    CHECK(cell["candidates"].size() > 10);
    double best = 0;
    for (const char* list : {"views", "candidates"}) {
      for (const auto& view : cell[list]) {
        best = std::max(best, view["true_gain_m3"].get<double>());
        CHECK(view["expected_m3"].get<double>() >= view["interval_m3"][0].get<double>());
        CHECK(view["expected_m3"].get<double>() <= view["interval_m3"][1].get<double>());
        CHECK(view["true_gain_m3"].get<double>() <= cell["shadow_m3"].get<double>() * (1 + 1e-9));
      }
    }
    CHECK(cell["best_true_gain_m3"] == best);
    // By its own number, the pick by expected gain is no worse than the other.
    CHECK(cell["views"][0]["expected_m3"].get<double>() >=
          0.95 * cell["views"][1]["expected_m3"].get<double>());
  }
}

TEST_CASE("evaluate expected-gain without a cell says what to give") {
  const auto none = run_vantage("evaluate expected-gain");
  CHECK(none.exit_code == 3);
  CHECK(none.out.empty());
  CHECK(none.err.find("--random") != std::string::npos);
}

}  // namespace vantage
