#include "documents/schema_check.hpp"

#include <doctest/doctest.h>

#include "documents/schemas.hpp"
#include "documents/yaml_document.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

using nlohmann::json;

const json kSchema = json::parse(R"({
  "type": "object", "additionalProperties": false, "required": ["area"],
  "properties": {
    "area": {"description": "where to look", "$ref": "#/definitions/area"},
    "size": {"type": "number", "exclusiveMinimum": 0, "maximum": 10},
    "count": {"type": "integer", "minimum": 1},
    "method": {"enum": ["voxel", "mesh"]},
    "title": {"type": ["string", "null"]},
    "name": {"type": "string", "minLength": 1},
    "hash": {"type": "string", "pattern": "^[0-9a-f]{4}$"},
    "on": {"type": "boolean"},
    "list": {"type": "array", "minItems": 1, "maxItems": 3, "items": {"$ref": "#/definitions/shape"}},
    "free": {"type": "object"},
    "limits": {"type": "object", "additionalProperties": {"type": "number", "minimum": 0}},
    "ways": {"type": "array", "minItems": 1, "items": {
      "if": {"properties": {"kind": {"const": "ship"}}, "required": ["kind"]},
      "then": {"$ref": "#/definitions/ship"},
      "else": {"if": {"required": ["wheels"]}, "then": {"$ref": "#/definitions/car"},
               "else": {"type": "object", "additionalProperties": false}}}}
  },
  "definitions": {
    "area": {"type": "object", "additionalProperties": false, "required": ["min_m", "max_m"],
      "properties": {"min_m": {"$ref": "#/definitions/vector"}, "max_m": {"$ref": "#/definitions/vector"}}},
    "ship": {"type": "object", "additionalProperties": false, "required": ["kind", "draught_m"],
      "properties": {"kind": {"enum": ["ship"]}, "draught_m": {"type": "number", "minimum": 0}}},
    "car": {"type": "object", "additionalProperties": false,
      "properties": {"kind": {"type": "string"}, "wheels": {"type": "integer", "minimum": 3}}},
    "vector": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number"}},
    "shape": {"type": "object", "additionalProperties": false,
      "oneOf": [{"required": ["box"]}, {"required": ["mesh"]}],
      "properties": {"box": {"type": "number", "minimum": 0}, "mesh": {"type": "string"}}}
  }})");

constexpr std::string_view kGoodLine = "area: {min_m: [0, 0, 0], max_m: [1, 1, 1]}\n";

void check_yaml(const std::string& text) {
  check_schema(parse_yaml(text, "cell.yaml"), kSchema);
}

/// `text` stands in line 2, behind a good line.
void expect_line_refused(const std::string& text, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(text);
  expect_refused([&] { check_yaml(std::string(kGoodLine) + text); }, where, parts);
}

}  // namespace

TEST_CASE("a document that fits its schema passes") {
  CHECK_NOTHROW(check_yaml(std::string(kGoodLine)));
  CHECK_NOTHROW(
      check_yaml(std::string(kGoodLine) +
                 "size: 10\ncount: 1\nmethod: mesh\ntitle: ~\nname: x\nhash: 0a1b\non: true\n"
                 "list: [{box: 0}, {mesh: a.stl}]\nfree: {any: [thing]}\nlimits: {a: 1}\n"));
}

TEST_CASE("an unknown key is refused with the nearest known one") {
  expect_refused([] { check_yaml("area:\n  min_m: [0, 0, 0]\n  maxx: [1, 1, 1]\n"); },
                 "cell.yaml:3: area.maxx", {"unknown key", "did you mean \"max_m\""});
  expect_line_refused("siez: 1", "cell.yaml:2: siez", {"did you mean \"size\""});
  expect_line_refused("Method: mesh", "cell.yaml:2: Method", {"did you mean \"method\""});
  expect_line_refused("list: [{mehs: a}]", "cell.yaml:2: list[0].mehs", {"did you mean \"mesh\""});
  expect_line_refused("list: [{zzzzzzzz: a}]", "cell.yaml:2: list[0].zzzzzzzz",
                      {"unknown key", "box, mesh"});
  expect_line_refused(std::string(900, 'k') + ": 1", "k", {"the keys here are"});
}

TEST_CASE("a missing key is refused with what it is") {
  expect_refused([] { check_yaml("size: 1\n"); }, "cell.yaml:1: area",
                 {"missing", "an object", "where to look"});
  expect_refused([] { check_yaml("size: 1\narea: {min_m: [0, 0, 0]}\n"); },
                 "cell.yaml:2: area.max_m", {"missing", "an array of 3 numbers"});
}

TEST_CASE("a value of the wrong type is refused with the value and the type") {
  expect_refused([] { check_yaml("[1, 2]"); }, "cell.yaml:1", {"found [1,2]", "an object"});
  expect_line_refused("size: \"5\"", "cell.yaml:2: size",
                      {"found \"5\" (a string)", "a number > 0 and <= 10"});
  expect_line_refused("size:", "cell.yaml:2: size", {"nothing (null)", "a number"});
  expect_line_refused("count: 1.5", "cell.yaml:2: count", {"found 1.5", "a whole number >= 1"});
  expect_line_refused("title: 7", "cell.yaml:2: title", {"found 7", "a string or null"});
  expect_line_refused("on: yes", "cell.yaml:2: on", {"found \"yes\" (a string)", "true or false"});
  expect_line_refused("list: 3", "cell.yaml:2: list", {"found 3", "an array of 1 to 3 objects"});
  expect_refused([] { check_yaml("area:\n  max_m: [1, 1, 1]\n  min_m:\n  - 0\n  - x\n  - 0\n"); },
                 "cell.yaml:5: area.min_m[1]", {"found \"x\" (a string)", "a number"});
}

TEST_CASE("a number that is not finite is refused") {
  expect_line_refused("size: .nan", "cell.yaml:2: size", {"found nan", "finite"});
  expect_line_refused("free: {a: [.inf]}", "cell.yaml:2: free.a[0]", {"found inf", "finite"});
}

TEST_CASE("a value out of its limits is refused with the limits") {
  expect_line_refused("size: 0", "cell.yaml:2: size", {"found 0", "a number > 0 and <= 10"});
  expect_line_refused("size: 11", "cell.yaml:2: size", {"found 11"});
  expect_line_refused("count: 0", "cell.yaml:2: count", {"found 0", "a whole number >= 1"});
  expect_line_refused("method: ray", "cell.yaml:2: method",
                      {"found \"ray\"", "\"voxel\", \"mesh\""});
  expect_line_refused("name: ''", "cell.yaml:2: name", {"found \"\"", "not empty"});
  expect_line_refused("hash: xyzw", "cell.yaml:2: hash", {"found \"xyzw\"", "[0-9a-f]{4}"});
  expect_line_refused("list: []", "cell.yaml:2: list", {"found []", "1 to 3 objects"});
  expect_line_refused("list:\n  - mesh: a\n  - box: -1", "cell.yaml:4: list[1].box",
                      {"found -1", "a number >= 0"});
  expect_line_refused("limits: {a: -1}", "cell.yaml:2: limits.a", {"found -1", "a number >= 0"});
  expect_refused([] { check_yaml("area: {min_m: [0, 0], max_m: [1, 1, 1]}\n"); },
                 "cell.yaml:1: area.min_m", {"found [0,0]", "an array of 3 numbers"});
}

TEST_CASE("one of two keys has to be there, and not both") {
  expect_line_refused("list: [{}]", "cell.yaml:2: list[0]",
                      {"found {}", "exactly one of the keys \"box\", \"mesh\""});
  expect_line_refused("list: [{box: 1, mesh: a}]", "cell.yaml:2: list[0]",
                      {"exactly one of the keys"});
}

TEST_CASE("a name, or an object with one of two keys") {
  const nlohmann::json schema{{"properties",
                               {{"body",
                                 {{"type", {"string", "object"}},
                                  {"oneOf",
                                   {{{"enum", {"usual", "none"}}},
                                    {{"type", "object"}, {"required", {"sphere"}}},
                                    {{"type", "object"}, {"required", {"box"}}}}}}}}}};
  const auto check = [&](const std::string& body) {
    check_schema(parse_yaml("body: " + body + "\n", "cell.yaml"), schema);
  };
  for (const char* good : {"usual", "none", "{sphere: 1}", "{box: 1}"}) CHECK_NOTHROW(check(good));
  for (const char* bad : {"nothing", "{}", "{sphere: 1, box: 1}"}) {
    expect_refused([&] { check(bad); }, "cell.yaml:1: body",
                   {"one of \"usual\", \"none\", or exactly one of the keys \"sphere\", \"box\""});
  }
  expect_refused([&] { check("5"); }, "cell.yaml:1: body", {"found 5", "a string or an object"});
}

TEST_CASE("a value's type decides which keys it may have") {
  CHECK_NOTHROW(check_yaml(std::string(kGoodLine) +
                           "ways: [{kind: ship, draught_m: 2}, {kind: van, wheels: 4}, {}]\n"));
  expect_line_refused("ways: [{kind: ship}]", "cell.yaml:2: ways[0].draught_m", {"missing"});
  expect_line_refused("ways: [{kind: ship, wheels: 4}]", "ways[0].wheels",
                      {"unknown key", "draught_m, kind"});
  expect_line_refused("ways: [{kind: ship, draught_m: -1}]", "ways[0].draught_m",
                      {"found -1", "a number >= 0"});
  expect_line_refused("ways: [{}, {wheels: 2}]", "ways[1].wheels",
                      {"found 2", "a whole number >= 3"});
  expect_line_refused("ways: [{wheels: 4, weels: 4}]", "ways[0].weels", {"\"wheels\""});
  expect_line_refused("ways: [7]", "ways[0]", {"found 7", "an object"});
  expect_line_refused("ways: []", "ways", {"an array of 1 or more objects"});
}

TEST_CASE("the plan's schema takes what a plan has and nothing else") {
  const json plan = json::parse(R"({
    "vantage": "0.1.0", "method": "voxel", "score_unit": "m³", "partial": false,
    "finished_candidates": 2,
    "camera": {"width": 640, "height": 480, "fx": 525.0, "fy": 525.0, "cx": 319.5, "cy": 239.5,
               "near_m": 0.1, "far_m": 3.0},
    "best": {"id": 17, "T_world_cam": {"rotation": {"w": 1, "x": 0, "y": 0, "z": 0},
             "translation_m": [0, 0, 0]}, "score": 0.000943, "newly_observed_volume_m3": 0.000943,
             "servo_iteration": 2, "servo_trace": [],
             "polish": [{"move": "pan", "by_rad": -0.1, "T_world_cam":
               {"rotation": {"w": 1, "x": 0, "y": 0, "z": 0}, "translation_m": [0, 0, 0]}}]},
    "views": [], "ranked": [], "rejections": {"out of reach": 1}, "explanations": [],
    "candidates": [
      {"id": 17, "score": 0.0, "score_at_most": 0.0, "newly_observed_volume_m3": 0.0,
       "servo_iteration": 2, "feasible": true, "rejected": null},
      {"id": 18, "score": null, "score_at_most": null, "newly_observed_volume_m3": null,
       "servo_iteration": null, "feasible": false, "rejected": "out of reach"}],
    "volumes_m3": {"work_area": 0.0, "occupied": 0.0, "free": 0.0, "shadow": 0.0,
                   "shadow_hidden": 0.0, "shadow_unmeasured": 0.0, "shadow_outside": 0.0,
                   "shadow_unseen": 0.0},
    "anti_alias": {"applied": false, "volume_m3": 0.0},
    "conflicts": [{"object": "cup", "volume_m3": 0.0, "object_volume_m3": 0.0}],
    "shadow_regions": {"count": 1, "largest": [{"volume_m3": 0.0, "unmeasured_m3": 0.0, "unseen_m3": 0.0,
      "centroid_m": [0, 0, 0], "min_m": [0, 0, 0], "max_m": [0, 0, 0]}]},
    "warnings": ["the mesh of cup is not closed"],
    "voxel_size_m": 0.009375, "timing_ms": {"load": 0, "classify": 0, "score": 0, "total": 0},
    "config": {"threads": 2}, "inputs": [{"path": "a.json", "sha256":
      "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"}]})");
  const auto check = [](const json& document) {
    check_schema({"plan.json", document}, plan_schema());
  };
  CHECK_NOTHROW(check(plan));
  json changed = plan;
  changed["best"] = nullptr;
  for (const char* key : {"volumes_m3", "anti_alias", "conflicts", "shadow_regions"}) {
    changed[key] = nullptr;  // stopped early
  }
  CHECK_NOTHROW(check(changed));
  for (const auto& [key, unused] : plan.items()) {
    changed = plan;
    changed.erase(key);
    expect_refused([&] { check(changed); }, "plan.json: " + key, {"missing"});
  }
  changed = plan;
  changed["candidates"][1]["feasable"] = true;
  expect_refused([&] { check(changed); }, "plan.json: candidates[1].feasable", {"\"feasible\""});
  changed = plan;
  changed["shadow_regions"]["largest"][0]["centroid_m"] = {0, 0};
  expect_refused([&] { check(changed); }, "plan.json: shadow_regions.largest[0].centroid_m",
                 {"3 numbers"});
  changed = plan;
  changed["inputs"][0]["sha256"] = "0123";
  expect_refused([&] { check(changed); }, "plan.json: inputs[0].sha256", {"found \"0123\""});
  changed = plan;
  changed["best"]["servo_iteration"] = -1;
  expect_refused([&] { check(changed); }, "plan.json: best.servo_iteration", {"found -1"});
  changed = plan;
  changed["best"]["polish"][0]["move"] = "roll";
  expect_refused([&] { check(changed); }, "plan.json: best.polish[0].move", {"found \"roll\""});
}

}  // namespace vantage::test
