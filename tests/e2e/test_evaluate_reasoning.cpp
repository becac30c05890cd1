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

std::string few_scenes(const std::string& options) {
  return "evaluate reasoning" + quoted_workcell("clutter") +
         " --objects 5 --scenes 3 --depth-width 80 " + options;
}

}  // namespace

TEST_CASE("evaluate reasoning writes reasoning.json, the same at any number of threads") {
  const test::TemporaryFolder folder;
  const auto one = run_vantage(few_scenes("--threads 1 --json -o" + quoted(folder / "out")));
  CAPTURE(one.err);
  REQUIRE(one.exit_code == 0);
  const json reasoning = one.json();
  CHECK_NOTHROW(check_schema(Document{"reasoning.json", reasoning}, reasoning_schema()));
  CHECK(reasoning == json::parse(test::read_text(folder / "out/reasoning.json")));
  CHECK(reasoning["scenes"] == 3);
  CHECK(reasoning["true_objects"].get<int>() >= 12);
  for (const json& result : reasoning["results"]) {
    CAPTURE(result["evidence"]);
    CHECK(result["at"][0]["recall"].get<double>() > 0.7);
  }
  CHECK(run_vantage(few_scenes("--threads 3 --json")).json() == reasoning);
  CHECK(run_vantage(few_scenes("--seed 50 --json")).json()["results"] != reasoning["results"]);
}

TEST_CASE("evaluate reasoning prints phantoms and recall for each kind of evidence") {
  const auto result = run_vantage(few_scenes("--methods svd,pnp"));
  REQUIRE(result.exit_code == 0);
  for (const char* part :
       {"Phantoms and recall, 3 scenes", "svd", "pnp", "none: the method alone", "all but depth"}) {
    CAPTURE(part);
    CHECK(result.out.find(part) != std::string::npos);
  }
}

TEST_CASE("evaluate reasoning says what it cannot do") {
  CHECK(run_vantage(few_scenes("--drop 2")).exit_code == 2);
  CHECK(run_vantage(few_scenes("--methods magic")).exit_code == 2);
  const auto result = run_vantage(few_scenes("--types lorry"));
  CHECK(result.exit_code == 3);
  CHECK(result.err.find("lorry") != std::string::npos);
}

}  // namespace vantage
