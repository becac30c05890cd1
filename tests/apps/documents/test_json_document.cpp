#include "documents/json_document.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdint>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

using nlohmann::json;

void expect_json_refused(std::string_view text, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(text.substr(0, 100));
  expect_refused([&] { parse_json(text, "t.json"); }, where, parts);
}

}  // namespace

TEST_CASE("JSON is read with the lines of its values") {
  const char* text = R"({"a": {"b/c": [1,
      -2.5e0, true
      ], "d": null},
    "e":
      "text\nmore"})";
  const Document document = parse_json(text, "t.json");
  CHECK(document.root == json::parse(text));
  CHECK(document.line("/a/b~1c/0") == 1);
  CHECK(document.line("/a/b~1c/1") == 2);
  CHECK(document.line("/a/d") == 3);
  CHECK(document.line("/e") == 4);
  CHECK(document.place("/a/b~1c/2") == "t.json:2: a.b/c[2]");
  CHECK(parse_json("[1,\r2]", "t.json").line("/1") == 2);
  CHECK(parse_json("[1]", "lines.jsonl", kJsonLimits, {}, 7).place("/0") == "lines.jsonl:7: [0]");
  CHECK(parse_json("\xEF\xBB\xBF[1]", "t.json").root == json::parse("[1]"));
  CHECK(parse_json("18446744073709551615", "t.json").root.get<std::uint64_t>() == UINT64_MAX);
}

TEST_CASE("invalid JSON is refused with line and column") {
  expect_json_refused("{\"a\": 1,\n \"b\": }", "t.json:2:7", {"invalid or truncated JSON"});
  expect_json_refused("{},", "t.json:1:3", {"invalid or truncated JSON"});
  expect_json_refused("{\"a\": 1", "t.json:1:8", {"invalid or truncated JSON", "truncated"});
  expect_json_refused("[01]", "t.json:1:3", {"invalid or truncated JSON"});
  expect_json_refused("[1e999]", "t.json:1:6", {"invalid or truncated JSON", "1e999"});
  expect_json_refused("[\"\xff\"]", "t.json:1:3", {"UTF-8"});
  expect_json_refused("[1, // a comment\n2]", "t.json:1:5", {"invalid or truncated JSON"});
  expect_json_refused("[NaN]", "t.json:1:2", {"invalid or truncated JSON"});
  expect_json_refused("", "t.json", {"empty"});
  expect_json_refused(" \r\n\t", "t.json", {"empty"});
}

TEST_CASE("duplicate keys are refused, however many there are") {
  expect_json_refused("{\"a\": 1,\n\"b\": 2,\n\"a\": 3}", "t.json:3:3",
                      {"\"a\"", "twice", "line 1"});
  expect_json_refused("[{\"a\": {}},\n {\"b\": 1, \"b\": 1}]", "t.json:2:13", {"twice", "line 2"});
  std::string many = "{";
  for (int i = 0; i < 100'000; ++i) many += fmt::format("\"{}\": {{\"cam_K\": [1]}},\n", i);
  CHECK(parse_json(many + "\"x\": 0}", "t.json").root.size() == 100'001);  // at once: not quadratic
  expect_json_refused(many + "\"77\": 0}", "t.json:100001:4", {"\"77\"", "line 78"});
}

TEST_CASE("limits of JSON") {
  CHECK_NOTHROW(parse_json(std::string(64, '[') + std::string(64, ']'), "t.json"));
  expect_json_refused(std::string(1'000'000, '['), "t.json:1:65", {"64 levels"});
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "{\"a\":";
  expect_json_refused(deep, "t.json:1:321", {"64 levels"});
  expect_json_refused("{\"" + std::string(1025, 'k') + "\": 1}", "t.json:1:1028", {"1025", "1024"});
  std::string many = "[";
  while (many.size() < (16u << 20)) many += "1,";
  expect_json_refused(many, "t.json:1:4000001", {"2000000 values"});
  const StopToken stop;
  stop.cancel();
  expect_error(ErrorCode::cancelled, "t.json", "cancelled",
               [&] { parse_json(many, "t.json", kJsonLimits, stop); });
}

TEST_CASE("a file's name says whether it is JSON or YAML") {
  TemporaryFolder folder;
  CHECK(read_document(folder.write("a.json", "{\"a\": \"yes\"}")).root["a"] == "yes");
  CHECK(read_document(folder.write("a.yaml", "a: yes")).root["a"] == "yes");
  CHECK(read_document(folder.write("b.yaml", "{\"a\": \"yes\"}")).root["a"] == "yes");
  expect_refused([&] { read_document(folder.write("b.json", "a: 1")); }, "b.json:1:1", {"JSON"});
  const auto large = folder.write("large.json", std::string((64u << 20) + 1, ' '));
  expect_refused([&] { read_document(large); }, "large.json", {"67108864"});
}

}  // namespace vantage::test
