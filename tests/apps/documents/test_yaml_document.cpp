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
  CHECK(value("0." + std::string(2000, '3')) == json(1.0 / 3));
  CHECK(value("!!float 3").is_number_float());
  CHECK(value("!!int '3'") == json(3));
  CHECK(value("!!null ''").is_null());
}

TEST_CASE("maps and sequences become objects and arrays, with their lines") {
  const Document document = parse_yaml(
      "# a comment\nbox:\n  min: [1, 2,\n    3]\n\nlist:\n  - a: 1\n  - b/c: {}\n", "t.yaml");
  CHECK(document.root ==
        json::parse(R"({"box": {"min": [1, 2, 3]}, "list": [{"a": 1}, {"b/c": {}}]})"));
  CHECK(document.line("/box") == 2);
  CHECK(document.line("/box/min") == 3);
  CHECK(document.line("/box/min/2") == 4);
  CHECK(document.line("/list/1/b~1c") == 8);
  CHECK(document.place("/box/min/2") == "t.yaml:4: box.min[2]");
  CHECK(document.place("/list/0/a") == "t.yaml:7: list[0].a");
  CHECK(document.place("/box/max") == "t.yaml:2: box.max");  // missing: the line of what lacks it
  CHECK(document.place("/list/7/x") == "t.yaml:6: list[7].x");
}

TEST_CASE("a document without lines names the file and the key") {
  const Document document{"plan.json", json::parse(R"({"a": [1]})")};
  CHECK(document.place("/a/0") == "plan.json: a[0]");
  CHECK(document.place("") == "plan.json");
  CHECK(document.place("/a/x/99999999999999999999") == "plan.json: a.x.99999999999999999999");
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
  expect_yaml_refused("a: [1, 2\nb: 3\n", "t.yaml:2:2", {"invalid YAML", "',' or ']'", "line 1"});
  expect_yaml_refused("a: 1\n b: 2\n", "t.yaml:2:3", {"invalid YAML", "mapping values"});
  expect_yaml_refused("a: *nowhere\n", "t.yaml:1:4", {"*nowhere", "&nowhere"});
  expect_yaml_refused("a: 1\r\nb: \"\\q\"\r\n", "t.yaml:2:5", {"escape"});
  expect_yaml_refused("a: 1\n\tb: 2\n", "t.yaml:2:1", {"tab"});
}

TEST_CASE("a duplicate key is refused with both lines") {
  expect_yaml_refused("a: 1\nb: 2\na: 3\n", "t.yaml:3:1", {"\"a\"", "twice", "line 1"});
  expect_yaml_refused("x:\n  a: 1\n  'a': 2\n", "t.yaml:3:3", {"\"a\"", "line 2"});
}

TEST_CASE("keys that are not words, unknown tags and numbers out of range are refused") {
  expect_yaml_refused("a: 1\n? [x, y]\n: 2\n", "t.yaml:2:3", {"key"});
  expect_yaml_refused("a: !point [1, 2]\n", "t.yaml:1:4", {"!point"});
  expect_yaml_refused("a: !!python/object {}\n", "t.yaml:1:4", {"python/object"});
  expect_yaml_refused("\na: 1e999\n", "t.yaml:2:4", {"1e999", "out of range"});
  expect_yaml_refused("a: 0xffffffffffffffffff\n", "t.yaml:1:4", {"out of range"});
  expect_yaml_refused("a: " + std::string(2000, '7'), "t.yaml:1:4", {"7777", "out of range"});
  expect_yaml_refused("a: !!int 0.5\n", "t.yaml:1:4", {"0.5", "!!int"});
}

TEST_CASE("nesting without end and alias bombs are refused") {
  expect_yaml_refused("a: " + std::string(65, '[') + std::string(65, ']'), "t.yaml:1:67", {"64"});
  CHECK_NOTHROW(parse_yaml(std::string(64, '[') + std::string(64, ']'), "t.yaml"));
  CHECK_THROWS_AS(parse_yaml(std::string(1'000'000, '['), "t.yaml"), Error);
  CHECK_THROWS_AS(parse_yaml(std::string(100'000, '{'), "t.yaml"), Error);
  std::string steps;
  for (int i = 0; i < 2000; ++i) steps += std::string(std::size_t(i), ' ') + "a:\n";
  CHECK_THROWS_AS(parse_yaml(steps, "t.yaml"), Error);

  expect_yaml_refused("a: &a [*a]\n", "t.yaml:1:8", {"*a", "contains itself"});
  std::string bomb = "x0: &x0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string alias = std::string("*x").append(std::to_string(i - 1)).append(", ");
    bomb.append("x").append(std::to_string(i)).append(": &x").append(std::to_string(i));
    bomb.append(" [" + alias + alias + alias + alias + alias + alias + alias + "0]\n");
  }
  expect_yaml_refused(bomb, "t.yaml:7:20", {"1000000", "aliases"});

  // A long word counts as often as it is there.
  std::string long_words = "x: &x " + std::string(1 << 20, 'x') + "\ny: [";
  for (int i = 0; i < 100; ++i) long_words += "*x, ";
  expect_yaml_refused(long_words + "*x]\n", "t.yaml:2:57", {"16777216", "text"});
}

TEST_CASE("what never ended with other readers ends at once, with its place") {
  expect_yaml_refused("{},", "t.yaml:1:3", {"invalid YAML"});
  expect_yaml_refused("{}\n,\n", "t.yaml:2:1", {"invalid YAML"});
  expect_yaml_refused("[1], [2]", "t.yaml:1:4", {"invalid YAML"});
  // 16 MB of values: refused at the limit, not after all of them took memory.
  std::string many = "[";
  while (many.size() < (16u << 20) - 10) many += "1,";
  expect_yaml_refused(many, "t.yaml:1:2000000", {"1000000 values"});
}

TEST_CASE("keys have a longest") {
  CHECK_NOTHROW(parse_yaml("? " + std::string(1024, 'k') + "\n: 1\n", "t.yaml"));
  expect_yaml_refused("? " + std::string(1025, 'k') + "\n: 1\n", "t.yaml:1:3", {"1025", "1024"});
}

TEST_CASE("lines may end in LF, CR LF or CR, and a byte order mark is passed over") {
  const json expected = json::parse(R"({"a": {"b": [1, 2]}, "c": "d"})");
  for (const std::string text :
       {"a:\n  b:\n    - 1\n    - 2\nc: d\n", "a:\r\n  b:\r\n    - 1\r\n    - 2\r\nc: d\r\n",
        "a:\r  b:\r    - 1\r    - 2\rc: d\r",
        "\xEF\xBB\xBF"
        "a:\n  b: [1,\n   2]\n\nc: d"}) {
    CAPTURE(text);
    const Document document = parse_yaml(text, "t.yaml");
    CHECK(document.root == expected);
    CHECK(document.line("/c") == 5);
  }
}

TEST_CASE("text that is no UTF-8 and control characters are refused with their place") {
  expect_yaml_refused("a: 1\nb: \xff\n", "t.yaml:2:4", {"UTF-8", "0xff"});
  expect_yaml_refused("a: \xc3", "t.yaml:1:4", {"UTF-8"});
  expect_yaml_refused("a: 1\rb: \x01\n", "t.yaml:2:4", {"control"});
  expect_yaml_refused(std::string_view("a: \0", 4), "t.yaml:1:4", {"control"});
}

TEST_CASE("merge keys add what a mapping does not have itself") {
  const auto merged = [](const std::string& text) {
    return parse_yaml("base: &b {x: 1, y: 2}\nmore: &m {y: 3, z: 4}\n" + text, "t.yaml").root["v"];
  };
  CHECK(merged("v: {<<: *b, y: 5}\n") == json::parse(R"({"x": 1, "y": 5})"));
  CHECK(merged("v: {y: 5, <<: *b}\n") == json::parse(R"({"x": 1, "y": 5})"));
  CHECK(merged("v:\n  <<: [*m, *b]\n  w: 0\n") ==
        json::parse(R"({"x": 1, "y": 3, "z": 4, "w": 0})"));
  CHECK(merged("v: {<<: {q: [1]}}\n") == json::parse(R"({"q": [1]})"));
  CHECK(merged("v: {'<<': 1}\n") == json::parse(R"({"<<": 1})"));  // quoted: a key like others
  expect_yaml_refused("a: 1\nv: {<<: 7}\n", "t.yaml:2:9", {"merges mappings"});
  expect_yaml_refused("v: {<<: [{}, 7]}\n", "t.yaml:1:9", {"merges mappings"});
  expect_yaml_refused("v: {<<: {}, <<: {}}\n", "t.yaml:1:13", {"twice"});
}

TEST_CASE("OpenCV's header and tags are passed over on request") {
  const std::string text =
      "%YAML:1.0\n---\nimage_width: 640\ncamera_matrix: !!opencv-matrix\n   rows: 1\n   cols: 2\n"
      "   dt: d\n   data: [ 600., .Nan ]\nt: !!python/tuple [1, !!int '2']\n";
  const Document document = parse_yaml(text, "c.yml", {.ignore_tags = true});
  CHECK(document.root["camera_matrix"]["data"][0] == json(600.0));
  CHECK(std::isnan(document.root["camera_matrix"]["data"][1].get<double>()));
  CHECK(document.root["t"] == json::parse("[1, 2]"));
  CHECK(document.place("/camera_matrix/rows") == "c.yml:5: camera_matrix.rows");
  expect_yaml_refused(text, "t.yaml:1:6", {"invalid YAML"});
}

TEST_CASE("reading stops soon after it was cancelled") {
  std::string many = "[";
  for (int i = 0; i < 10'000; ++i) many += "1, ";
  const StopToken stop;
  stop.cancel();
  expect_error(ErrorCode::cancelled, "t.yaml", "cancelled",
               [&] { parse_yaml(many + "1]", "t.yaml", {}, stop); });
}

TEST_CASE("no document and many are refused") {
  expect_yaml_refused("", "t.yaml", {"empty"});
  expect_error(ErrorCode::bad_input, "t.yaml", "empty",
               [] { parse_yaml(std::string_view(), "t.yaml"); });
  expect_yaml_refused("# only a comment\n", "t.yaml", {"empty"});
  expect_yaml_refused("a: 1\n---\nb: 2\n", "t.yaml:2:1", {"second document", "expected one"});
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
