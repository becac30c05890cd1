#include <doctest/doctest.h>

#include <CLI/CLI.hpp>
#include <string>

#include "cli/help_formatter.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

enum class Fruit { apple, pear };

/// One field of every kind.
struct Everything {
  bool ripe = false;
  int count = 3;
  double mass_kg = 0.5;
  Fruit fruit = Fruit::apple;
  std::optional<bool> washed;
  std::optional<double> price;
  Eigen::Vector3d place_m = {1, 2, 3};
  std::vector<double> radii_m;
  std::vector<int> counts = {4};
  bool peeled = false;
  std::uint64_t seed = 5;
  std::string note = "none";
  std::vector<std::string> shelves = {"top"};
};

FieldGroup fields_of(Everything& all) {
  return {
      "",
      "Fruit",
      {{.key = "ripe", .value = &all.ripe, .help = "Ripe", .option = "--ripe"},
       {.key = "count",
        .value = &all.count,
        .help = "Pieces",
        .option = "--count",
        .range = from_to(0, 100)},
       {.key = "fruit",
        .value = choice(all.fruit, {{"apple", Fruit::apple}, {"pear", Fruit::pear}}),
        .help = "Kind",
        .option = "--fruit"},
       {.key = "washed", .value = &all.washed, .help = "Washed", .option = "--washed"},
       {.key = "price", .value = &all.price, .help = "Price", .range = not_negative()},
       {.key = "peeled",
        .value = &all.peeled,
        .help = "Peeled",
        .option = "--peeled",
        .flag = true},
       {.key = "seed", .value = &all.seed, .help = "Seed", .option = "--seed", .range = {.min = 2}},
       {.key = "note", .value = &all.note, .help = "Note", .option = "--note"},
       {.key = "shelves",
        .value = NameList{{"top", "middle"}, &all.shelves},
        .help = "Shelves",
        .option = "--shelves"}},
      {{"where",
        "Place",
        {{.key = "mass_kg",
          .value = &all.mass_kg,
          .help = "Mass",
          .option = "--mass",
          .unit = "kg",
          .range = positive(),
          .expert = true},
         {.key = "place_m", .value = &all.place_m, .help = "Place", .option = "--place"},
         {.key = "radii_m",
          .value = &all.radii_m,
          .help = "Radii",
          .option = "--radii",
          .unit = "m",
          .range = positive(),
          .fallback = "from the size"},
         {.key = "counts", .value = &all.counts, .help = "Counts", .option = "--counts"}}}}};
}

/// What the command line makes of the defaults.
Everything parsed(const std::string& line) {
  CLI::App app;
  Everything all;
  nlohmann::json given = nlohmann::json::object();
  add_fields(app, fields_of(all), given);
  app.parse(line);
  CHECK(to_json(fields_of(all)) == [] {  // parsing alone changes nothing
    Everything untouched;
    return to_json(fields_of(untouched));
  }());
  read_given(given, fields_of(all));
  return all;
}

std::string refusal(const std::string& line) {
  try {
    parsed(line);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return {};
}

std::string help(const std::string& flag) {
  CLI::App app("", "fruit");
  set_up_help(app);
  Everything all;
  nlohmann::json given;
  add_fields(app, fields_of(all), given);
  try {
    app.parse(flag);
  } catch (const CLI::CallForHelp&) {
    return app.help("", CLI::AppFormatMode::Normal);
  } catch (const CLI::CallForAllHelp&) {
    return app.help("", CLI::AppFormatMode::All);
  }
  return {};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("fields: what the command line gives arrives, the rest stays") {
  const Everything none = parsed("");
  CHECK(none.count == 3);
  CHECK(!none.washed);
  const Everything all = parsed(
      "--ripe on --count 7 --fruit pear --washed off --mass 1e-3 --place 0 -1 2.5 --radii 0.5,+1 "
      "--counts 1,2 --peeled --seed 18446744073709551615 --note 2-9 --shelves middle,top");
  CHECK(all.peeled);
  CHECK(all.seed == 18446744073709551615u);
  CHECK(all.note == "2-9");
  CHECK(all.shelves == std::vector<std::string>{"middle", "top"});
  CHECK(all.ripe);
  CHECK(all.count == 7);
  CHECK(all.fruit == Fruit::pear);
  CHECK(all.washed == false);
  CHECK(all.mass_kg == 1e-3);
  CHECK(all.place_m == Eigen::Vector3d(0, -1, 2.5));
  CHECK(all.radii_m == std::vector{0.5, 1.0});
  CHECK(all.counts == std::vector{1, 2});
}

TEST_CASE("fields: the command line's errors have the value and what was expected") {
  CHECK(has(refusal("--count 101"), "found '101'; expected an integer from 0 to 100"));
  CHECK(has(refusal("--count 1.5"), "found '1.5'; expected an integer"));
  CHECK(has(refusal("--mass 0"), "found '0'; expected a number above 0"));
  CHECK(has(refusal("--mass nan"), "found 'nan'"));
  CHECK(has(refusal("--mass inf"), "found 'inf'"));
  CHECK(has(refusal("--radii 1,-1"), "found '-1'; expected a number above 0"));
  CHECK(has(refusal("--fruit plum"), "found 'plum'; expected one of apple, pear"));
  CHECK(has(refusal("--ripe yes"), "found 'yes'; expected one of on, off"));
  CHECK(has(refusal("--seed 1"), "found '1'; expected an integer, 2 or above"));
  CHECK(has(refusal("--seed 18446744073709551616"), "found '18446744073709551616'"));
  CHECK(has(refusal("--shelves top,low"), "found 'low'; expected one of top, middle"));
  CHECK(!refusal("--place 1 2").empty());
}

TEST_CASE("fields: JSON that was written reads as the same values") {
  Everything all{true, 9, 2.5, Fruit::pear, true, 3.25, {4, 5, 6}, {0.1}, {7, 8}, true, 6, "x", {}};
  const auto json = to_json(fields_of(all));
  CHECK(json["where"]["mass_kg"] == 2.5);
  CHECK(json["fruit"] == "pear");
  Everything read;
  read_given(json, fields_of(read));
  CHECK(to_json(fields_of(read)) == json);
  Everything defaults;
  CHECK(to_json(fields_of(defaults))["price"].is_null());
  const auto unset = to_json(fields_of(defaults));
  read_given(unset, fields_of(read));
  CHECK(read.price == 3.25);  // null leaves a value alone
}

TEST_CASE("fields: readers refuse what is out of range, with its place") {
  const auto refuses = [](const char* text, const char* place, const char* expected) {
    Everything all;
    const Document document{"fruit.yaml", nlohmann::json::parse(text)};
    expect_bad_input(place, expected, [&] { read_fields(Value(document), fields_of(all)); });
  };
  refuses(R"({"count": 101})", "fruit.yaml: count", "an integer from 0 to 100");
  refuses(R"({"seed": 1})", "fruit.yaml: seed", "an integer, 2 or above");
  refuses(R"({"where": {"mass_kg": 0}})", "fruit.yaml: where.mass_kg", "a number above 0");
  refuses(R"({"where": {"radii_m": [1, -2]}})", "fruit.yaml: where.radii_m[1]", "above 0");
}

TEST_CASE("fields: the schema has types, ranges, defaults and help") {
  Everything all;
  const auto schema = schema_of(fields_of(all));
  CHECK(schema["additionalProperties"] == false);
  const auto& count = schema["properties"]["count"];
  CHECK(count["type"] == "integer");
  CHECK(count["maximum"] == 100);
  CHECK(count["default"] == 3);
  CHECK(count["description"] == "Pieces");
  CHECK(schema["properties"]["seed"]["minimum"] == 2);
  CHECK(schema["properties"]["note"]["type"] == "string");
  CHECK(schema["properties"]["shelves"]["items"]["enum"] ==
        std::vector<std::string>{"top", "middle"});
  CHECK(schema["properties"]["fruit"]["enum"] == std::vector<std::string>{"apple", "pear"});
  const auto& where = schema["properties"]["where"]["properties"];
  CHECK(where["mass_kg"]["exclusiveMinimum"] == 0);
  CHECK(!where["radii_m"].contains("default"));
  CHECK(where["radii_m"]["items"]["exclusiveMinimum"] == 0);
}

TEST_CASE("help: grouped, expert options in --help-all only, 100 columns wide") {
  const std::string brief = help("--help"), full = help("--help-all");
  CHECK(has(brief, "Fruit:\n"));
  CHECK(has(brief, "--count N"));
  CHECK(has(brief, "Pieces (default: 3)"));
  CHECK(has(brief, "--fruit apple|pear"));
  CHECK(has(brief, "Radii (default: from the size)"));
  CHECK(has(brief, "Counts (default: 4)"));
  CHECK(has(brief, "--shelves top|middle,…"));
  CHECK(has(brief, "Shelves (default: top)"));
  CHECK(!has(brief, "--mass"));
  CHECK(has(brief, "--help-all"));
  CHECK(has(full, "--mass kg"));
  for (std::size_t at = 0; at < full.size();) {
    const std::size_t end = std::min(full.find('\n', at), full.size());
    CHECK(end - at <= 104);  // bytes; … takes three
    at = end + 1;
  }
}

}  // namespace vantage::test
