#include "documents/yaml_document.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

using nlohmann::json;

json value(const std::string& text) {
  return parse_yaml("v: " + text, "t.yaml").root["v"];
}

void expect_yaml_refused(std::string_view text, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(text.substr(0, 100));
  expect_refused([&] { parse_yaml(text, "t.yaml"); }, where, parts);
}

}  // namespace

TEST_CASE("plain scalars are typed by YAML 1.2's core schema") {
  CHECK(value("17") == json(17));
  CHECK(value("17").is_number_integer());
  CHECK(value("-0o17") == json("-0o17"));
  CHECK(value("0o17") == json(15));
  CHECK(value("0xff") == json(255));
  CHECK(value("017") == json(17));
  CHECK(value("+4") == json(4));
  for (const char* text : {"0.5", ".5", "+.5", "5e-1", "0.5e+0"}) {
    CAPTURE(text);
    CHECK(value(text).is_number_float());
    CHECK(value(text) == json(0.5));
  }
  CHECK(value("3.").is_number_float());
  CHECK(value("99999999999999999999") == json(1e20));
  CHECK(value("-.inf").get<double>() == -HUGE_VAL);
  CHECK(std::isnan(value(".nan").get<double>()));
  CHECK(value("true") == json(true));
  CHECK(value("FALSE") == json(false));
  for (const char* text : {"", "~", "null", "NULL"}) CHECK(value(text).is_null());
  for (const char* text :
       {"yes", "off", "nan", "inf", "1_000", "1:30", "1e", "0x", "- 1", "1.2.3"}) {
    CAPTURE(text);
    if (std::string_view(text) != "- 1") CHECK(value(text) == json(text));
  }
  CHECK(value("\"17\"") == json("17"));
  CHECK(value("'true'") == json("true"));
  CHECK(value("''") == json(""));
  CHECK(value("!!str 17") == json("17"));
  CHECK(value(std::string(2000, '7')) == json(std::string(2000, '7')));
}

TEST_CASE("maps and sequences become objects and arrays, with their lines") {
  const Document document = parse_yaml(
      "# a comment\nbox:\n  min: [1, 2,\n    3]\n\nlist:\n  - a: 1\n  - b/c: {}\n", "t.yaml");
  CHECK(document.root ==
        json::parse(R"({"box": {"min": [1, 2, 3]}, "list": [{"a": 1}, {"b/c": {}}]})"));
  CHECK(document.lines.at("/box") == 2);
  CHECK(document.lines.at("/box/min") == 3);
  CHECK(document.lines.at("/box/min/2") == 4);
  CHECK(document.lines.at("/list/1/b~1c") == 8);
  CHECK(document.place("/box/min/2") == "t.yaml:4: box.min[2]");
  CHECK(document.place("/list/0/a") == "t.yaml:7: list[0].a");
  CHECK(document.place("/box/max") == "t.yaml:2: box.max");  // missing: the line of what lacks it
  CHECK(document.place("/list/7/x") == "t.yaml:6: list[7].x");
}

TEST_CASE("a document without lines names the file and the key") {
  const Document document{"plan.json", json::parse(R"({"a": [1]})")};
  CHECK(document.place("/a/0") == "plan.json: a[0]");
  CHECK(document.place("") == "plan.json");
}

TEST_CASE("long values are cut off between characters") {
  const std::string text = shown(json("é" + std::string(56, 'x') + "éé" + std::string(50, 'x')));
  CHECK(text == "\"é" + std::string(56, 'x') + "… (a string)");
  CHECK(shown(json("short")) == "\"short\" (a string)");
}

TEST_CASE("aliases are expanded") {
  const Document document = parse_yaml("a: &box {min: 1}\nb: *box\n", "t.yaml");
  CHECK(document.root == json::parse(R"({"a": {"min": 1}, "b": {"min": 1}})"));
}

TEST_CASE("syntax errors carry line and column") {
  expect_yaml_refused("a: [1, 2\nb: 3\n", "t.yaml:2:2", {"no valid YAML"});
  expect_yaml_refused("a: 1\n b: 2\n", "t.yaml:2:3", {"no valid YAML"});
  expect_yaml_refused("a: *nowhere\n", "t.yaml:1:4", {"no valid YAML"});
}

TEST_CASE("a key that is there twice is refused with both lines") {
  expect_yaml_refused("a: 1\nb: 2\na: 3\n", "t.yaml:3", {"\"a\"", "twice", "line 1"});
  expect_yaml_refused("x:\n  a: 1\n  'a': 2\n", "t.yaml:3", {"\"a\"", "line 2"});
}

TEST_CASE("keys that are no words, tags and numbers out of range are refused") {
  expect_yaml_refused("a: 1\n? [x, y]\n: 2\n", "t.yaml:2", {"key"});
  expect_yaml_refused("a: !point [1, 2]\n", "t.yaml:1", {"!point"});
  expect_yaml_refused("a: !!python/object {}\n", "t.yaml:1", {"python/object"});
  expect_yaml_refused("\na: 1e999\n", "t.yaml:2", {"1e999", "out of range"});
  expect_yaml_refused("a: 0xffffffffffffffffff\n", "t.yaml:1", {"out of range"});
}

TEST_CASE("nesting without end and alias bombs are refused") {
  expect_yaml_refused("a: " + std::string(65, '[') + std::string(65, ']'), "t.yaml:1", {"64"});
  CHECK_NOTHROW(parse_yaml(std::string(64, '[') + std::string(64, ']'), "t.yaml"));
  // yaml-cpp has a limit of its own; what counts is that the stack survives.
  CHECK_THROWS_AS(parse_yaml(std::string(1'000'000, '['), "t.yaml"), Error);
  CHECK_THROWS_AS(parse_yaml(std::string(100'000, '{'), "t.yaml"), Error);
  std::string steps;
  for (int i = 0; i < 2000; ++i) steps += std::string(std::size_t(i), ' ') + "a:\n";
  CHECK_THROWS_AS(parse_yaml(steps, "t.yaml"), Error);

  expect_yaml_refused("a: &a [*a]\n", "t.yaml:1", {"64"});
  std::string bomb = "x0: &x0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string alias = std::string("*x").append(std::to_string(i - 1)).append(", ");
    bomb.append("x").append(std::to_string(i)).append(": &x").append(std::to_string(i));
    bomb.append(" [" + alias + alias + alias + alias + alias + alias + alias + "0]\n");
  }
  expect_yaml_refused(bomb, "t.yaml:1", {"100000", "aliases"});
}

TEST_CASE("no document and many are refused") {
  expect_yaml_refused("", "t.yaml", {"empty"});
  expect_yaml_refused("# only a comment\n", "t.yaml", {"empty"});
  expect_yaml_refused("a: 1\n---\nb: 2\n", "t.yaml:3", {"2 documents", "expected one"});
}

TEST_CASE("YAML files are read, unless they are missing or too large") {
  TemporaryFolder folder;
  CHECK(read_yaml(folder.write("a.yaml", "a: 1\n")).root == json::parse(R"({"a": 1})"));
  CHECK(read_yaml(folder / "a.yaml").name == (folder / "a.yaml").string());
  expect_refused([&] { read_yaml(folder / "b.yaml"); }, "b.yaml", {"o such file"});
  const auto large = folder.write("large.yaml", std::string((16u << 20) + 1, ' '));
  expect_refused([&] { read_yaml(large); }, "large.yaml", {"16777216"});
}

}  // namespace vantage::test
