#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <vantage/raycore/mesh_io.hpp>

#include "raycore/mesh_samples.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;
using Json = nlohmann::json;

namespace {

/// (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), then the indices 0 2 1, 0 1 3 of 16 bits.
std::string numbers() {
  std::string bytes;
  for (const float f : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) bytes += test::raw(f);
  for (const int i : {0, 2, 1, 0, 1, 3}) bytes += test::raw(std::uint16_t(i));
  return bytes;
}

/// Two triangles at one node.
Json sample() {
  return Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": 60, "uri": "numbers.bin"}]})");
}

/// The sample with changes: JSON pointers and their new values.
Json changed(std::initializer_list<std::pair<const char*, Json>> changes) {
  Json json = sample();
  for (const auto& [pointer, value] : changes) json[Json::json_pointer(pointer)] = value;
  return json;
}

TriangleMesh read_gltf_of(const Json& json, const MeshFileFrame& frame = {}) {
  const test::TemporaryFolder folder;
  folder.write("numbers.bin", numbers());
  return read_mesh(folder.write("a.gltf", json.dump()), frame);
}

std::string glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) { return test::raw(std::uint32_t(value)); };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

void expect_gltf_refused(const Json& json, std::string_view where, std::string_view message) {
  test::expect_bad_input(where, message, [&] { read_gltf_of(json); });
}

using Corners = std::vector<std::array<float, 3>>;

Corners corners_of(const TriangleMesh& mesh) {
  Corners result;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f p = mesh.corner(t, k);
      result.push_back({p.x() + 0, p.y() + 0, p.z() + 0});  // no -0
    }
  }
  return result;
}

/// glTF's y is up: (x, y, z) stands at (x, -z, y).
const Corners kStanding = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, -1, 0}};

}  // namespace

TEST_CASE("a glTF stands upright, from a file beside it, from its own text, or from a GLB") {
  CHECK(corners_of(read_gltf_of(sample())) == kStanding);
  const std::string base64 =
      "data:application/octet-stream;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMA";
  CHECK(corners_of(read_gltf_of(changed({{"/buffers/0/uri", base64}}))) == kStanding);
  Json json = sample();
  json["buffers"][0].erase("uri");
  const test::TemporaryFolder folder;
  CHECK(corners_of(read_mesh(folder.write("a.glb", glb(json.dump(), numbers())))) == kStanding);
  CHECK(corners_of(read_gltf_of(sample(), {1, UpAxis::z}))[1] == std::array{0.f, 1.f, 0.f});
  CHECK(corners_of(read_gltf_of(sample(), {0.001, {}}))[1] == std::array{0.f, 0.f, 0.001f});
}

TEST_CASE("nodes of a glTF move their meshes and those below them, and mirrors turn faces over") {
  const Json json =
      changed({{"/nodes", Json::parse(R"([{"children": [1], "translation": [10, 0, 0]},
      {"mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678], "scale": [2, 1, 1]}])")}});
  // x becomes 2x, then -z by a quarter turn about y.
  CHECK(corners_of(read_gltf_of(json))[2] == std::array{10.f, 2.f, 0.f});
  const Json mirrored =
      changed({{"/nodes/0/matrix", {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
  CHECK(corners_of(read_gltf_of(mirrored)) ==
        Corners{{0, -5, 0}, {1, -5, 0}, {0, -5, -1}, {0, -5, 0}, {0, -6, 0}, {1, -5, 0}});
}

TEST_CASE("strips, fans and lists without indices of a glTF") {
  Json json = sample();
  json["meshes"][0]["primitives"][0].erase("indices");
  const auto count = [&](int mode) {
    json["meshes"][0]["primitives"][0]["mode"] = mode;
    return read_gltf_of(json).triangles();
  };
  CHECK(count(4) == std::vector<Triangle>{{0, 1, 2}});
  CHECK(count(5) == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
  CHECK(count(6) == std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}});
  json["meshes"][0]["primitives"][0]["mode"] = 1;
  expect_gltf_refused(json, "a.gltf", "no triangles");
}

TEST_CASE("accessors of a glTF may be sparse, interleaved, or integers") {
  // Point 1 becomes point 3: its index and its place come from the numbers themselves.
  const Json sparse = changed({{"/accessors/0/sparse", Json::parse(R"({"count": 1,
      "indices": {"bufferView": 1, "byteOffset": 4, "componentType": 5123},
      "values": {"bufferView": 0, "byteOffset": 36}})")}});
  CHECK(corners_of(read_gltf_of(sparse))[2] == std::array{0.f, -1.f, 0.f});
  const Json apart = changed({{"/bufferViews/0/byteStride", 24},
                              {"/accessors/0/count", 2},
                              {"/accessors/1/count", 3},
                              {"/accessors/1/byteOffset", 6},
                              {"/meshes/0/primitives/0/mode", 4}});
  expect_gltf_refused(apart, "meshes[0].primitives[0]", "index 3");
  Json bytes = changed({{"/accessors/0/componentType", 5121},
                        {"/accessors/0/normalized", true},
                        {"/accessors/1/componentType", 5121},
                        {"/accessors/1/count", 3}});
  bytes["bufferViews"][0]["byteLength"] = 12;
  bytes["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", 12}, {"byteLength", 3}};
  // "data:;base64," and (0, 0, 0), (255, 0, 0), (0, 51, 0), (0, 0, 255), then 0, 1, 2
  bytes["buffers"][0] = {{"byteLength", 15}, {"uri", "data:;base64,AAAA/wAAADMAAAD/AAEC"}};
  CHECK(corners_of(read_gltf_of(bytes)) == Corners{{0, 0, 0}, {1, 0, 0}, {0, 0, 0.2f}});
}

TEST_CASE("glTF: sizes that do not fit are refused where they stand") {
  expect_gltf_refused(changed({{"/accessors/0/count", 5}}), "accessors[0]",
                      "5 elements of 12 bytes");
  expect_gltf_refused(changed({{"/accessors/0/count", 4e9}}), "accessors[0]",
                      "4000000000 elements");
  expect_gltf_refused(changed({{"/accessors/0/count", -1}}), "accessors[0].count", "is \"-1\"");
  expect_gltf_refused(changed({{"/accessors/0/type", "VEC2"}}), "accessors[0].type", "VEC2");
  expect_gltf_refused(changed({{"/accessors/0/componentType", 1}}), "accessors[0]",
                      "componentType 1");
  expect_gltf_refused(changed({{"/accessors/1/componentType", 5126}}), "accessors[1]", "5126");
  expect_gltf_refused(changed({{"/bufferViews/0/byteLength", 61}}), "bufferViews[0]", "61 bytes");
  expect_gltf_refused(changed({{"/bufferViews/0/byteStride", 4}}), "accessors[0]", "4 bytes apart");
  expect_gltf_refused(changed({{"/buffers/0/byteLength", 61}}), "buffers[0]", "states 61 bytes");
  expect_gltf_refused(changed({{"/nodes/0/mesh", 3}}), "meshes[3]", "does not exist");
  expect_gltf_refused(changed({{"/nodes/0/children", Json::array({0})}}), "nodes[0]",
                      "reached twice");
  expect_gltf_refused(changed({{"/nodes/0/rotation", {0, 0, 0, 2}}}), "nodes[0]", "norm 2");
  expect_gltf_refused(changed({{"/nodes/0/translation", {0, 0}}}), "nodes[0].translation",
                      "3 numbers");
  expect_gltf_refused(changed({{"/nodes/0/translation", {0, 0, 1e300}}}), "a.gltf, vertex 0",
                      "1e+06");
  expect_gltf_refused(changed({{"/meshes", 7}}), "meshes", "expected a list");
}

TEST_CASE("glTF: what is not read is named") {
  expect_gltf_refused(
      changed({{"/extensionsRequired", Json::array({"KHR_draco_mesh_compression"})}}),
      "extensionsRequired[0]", "KHR_draco_mesh_compression");
  CHECK(corners_of(read_gltf_of(changed(
            {{"/extensionsRequired", Json::array({"KHR_materials_unlit"})}}))) == kStanding);
  expect_gltf_refused(changed({{"/asset/version", "1.0"}}), "a.gltf", "1.0");
  const test::TemporaryFolder folder;
  test::expect_bad_input("a.glb", "version 1", [&] {
    read_mesh(folder.write("a.glb", "glTF" + test::raw(1u) + test::raw(12u)));
  });
  test::expect_bad_input("a.gltf", "nested deeper than 64",
                         [&] { read_mesh(folder.write("a.gltf", std::string(100000, '['))); });
  test::expect_bad_input("a.gltf", "JSON cannot be read",
                         [&] { read_mesh(folder.write("a.gltf", "{\"asset\": ")); });
  test::expect_bad_input("a.glb", "JSON cannot be read",
                         [&] { read_mesh(folder.write("a.glb", "x")); });
}

TEST_CASE("a GLB that is cut anywhere is an error") {
  Json json = sample();
  json["buffers"][0].erase("uri");
  const std::string whole = glb(json.dump(), numbers());
  const test::TemporaryFolder folder;
  for (std::size_t size = 1; size < whole.size(); size += 7) {
    test::expect_bad_input("a.glb", "",
                           [&] { read_mesh(folder.write("a.glb", whole.substr(0, size))); });
  }
}

TEST_CASE("a small glTF that shows a mesh a million times is refused before memory is gone") {
  Json json = sample();
  json["nodes"] = Json::array();
  for (int i = 0; i < 100; ++i) json["nodes"].push_back({{"mesh", 0}});
  json.erase("scenes");
  json["accessors"][0] = {{"componentType", 5126}, {"count", 1000000}, {"type", "VEC3"}};
  const auto error = test::caught([&] { read_gltf_of(json); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::out_of_resources);
}

TEST_CASE("a glTF reads files of its folder only, and regular ones only") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "meshes/below");
  folder.write("numbers.bin", numbers());
  folder.write("meshes/below/num bers.bin", numbers());
  const auto read_with = [&](const std::string& uri) {
    return read_mesh(folder.write("meshes/a.gltf", changed({{"/buffers/0/uri", uri}}).dump()));
  };
  CHECK(corners_of(read_with("below/num%20bers.bin")) == kStanding);
  const auto expect_kept_out = [&](const std::string& uri, std::string_view why) {
    test::expect_bad_input("a.gltf", why, [&] { read_with(uri); });
  };
  expect_kept_out("../numbers.bin", "leads out of the mesh's folder");
  expect_kept_out("below/../../numbers.bin", "leads out");
  expect_kept_out((folder / "numbers.bin").string(), "absolute");
  expect_kept_out("below", "not a regular file");
  expect_kept_out("gone.bin", "cannot be found");
  expect_kept_out("", "not a path");
  std::filesystem::create_symlink("../numbers.bin", folder / "meshes/link.bin");
  expect_kept_out("link.bin", "leads out");
  REQUIRE(::mkfifo((folder / "meshes/pipe.bin").c_str(), 0600) == 0);
  expect_kept_out("pipe.bin", "not a regular file");
}
