#include <doctest/doctest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <vantage/raycore/mesh_io.hpp>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;
using Eigen::Vector3f;

namespace {

TriangleMesh box_mesh() {
  return TriangleMesh::from_box(Box({0.1, 0.2, 0.3}, {1, 2, 3}));
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.substr(at, 4).data(), 4);
  return value;
}

/// A glTF binary taken apart.
struct Glb {
  nlohmann::json json;
  std::string binary;

  Vector3f vector(std::size_t accessor, std::size_t i) const {
    const auto& a = json.at("accessors").at(accessor);
    const auto& view = json.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
    const std::size_t at = view.at("byteOffset").get<std::size_t>() +
                           a.at("byteOffset").get<std::size_t>() +
                           i * view.at("byteStride").get<std::size_t>();
    Vector3f result;
    REQUIRE(at + 12 <= binary.size());
    std::memcpy(result.data(), binary.data() + at, 12);
    return result;
  }
};

Glb take_apart(const std::string& bytes) {
  REQUIRE(bytes.size() >= 20);
  CHECK(bytes.substr(0, 4) == "glTF");
  CHECK(word(bytes, 4) == 2);
  CHECK(word(bytes, 8) == bytes.size());
  const std::size_t json_size = word(bytes, 12);
  CHECK(json_size % 4 == 0);
  CHECK(bytes.substr(16, 4) == "JSON");
  Glb glb;
  glb.json = nlohmann::json::parse(bytes.substr(20, json_size));
  const std::size_t rest = 20 + json_size;
  if (bytes.size() == rest) return glb;
  CHECK(word(bytes, rest) % 4 == 0);
  CHECK(bytes.substr(rest + 4, 4) == std::string("BIN\0", 4));
  glb.binary = bytes.substr(rest + 8);
  CHECK(glb.binary.size() == word(bytes, rest));
  CHECK(glb.json.at("buffers").at(0).at("byteLength") == glb.binary.size());
  return glb;
}

Glb written(const std::vector<ColoredMesh>& meshes) {
  const test::TemporaryFolder folder;
  write_glb(folder / "a.glb", meshes);
  return take_apart(test::read_text(folder / "a.glb"));
}

}  // namespace

TEST_CASE("a PLY comes back as it was written") {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = box_mesh();
  write_ply(folder / "a.ply", mesh);
  const TriangleMesh read = read_mesh(folder / "a.ply");
  CHECK(read.vertices() == mesh.vertices());
  CHECK(read.triangles() == mesh.triangles());
}

TEST_CASE("the same mesh gives the same bytes") {
  const test::TemporaryFolder folder;
  write_ply(folder / "a.ply", box_mesh());
  write_ply(folder / "b.ply", box_mesh());
  CHECK(test::read_text(folder / "a.ply") == test::read_text(folder / "b.ply"));
  write_glb(folder / "a.glb", {{"box", box_mesh()}});
  write_glb(folder / "b.glb", {{"box", box_mesh()}});
  CHECK(test::read_text(folder / "a.glb") == test::read_text(folder / "b.glb"));
}

TEST_CASE("a PLY without faces can be written") {
  const test::TemporaryFolder folder;
  write_ply(folder / "a.ply", TriangleMesh());
  test::expect_bad_input("a.ply", "no triangles", [&] { read_mesh(folder / "a.ply"); });
}

TEST_CASE("a glTF binary has every corner, its normal and its bounds") {
  const TriangleMesh mesh = box_mesh();
  const Glb glb = written({{"first", mesh}, {"second", mesh.scaled(2)}});
  REQUIRE(glb.json.at("accessors").size() == 4);
  for (std::size_t number = 0; number < 2; ++number) {
    const float scale = number == 0 ? 1 : 2;
    const auto& attributes =
        glb.json.at("meshes").at(number).at("primitives").at(0).at("attributes");
    const auto positions = attributes.at("POSITION").get<std::size_t>();
    const auto normals = attributes.at("NORMAL").get<std::size_t>();
    CHECK(glb.json.at("accessors").at(positions).at("count") == 36);
    CHECK(glb.json.at("accessors").at(normals).at("count") == 36);
    Eigen::AlignedBox3f bounds;
    for (std::size_t i = 0; i < 36; ++i) {
      const Vector3f p = glb.vector(positions, i);
      bounds.extend(p);
      CHECK(p == Vector3f(scale * mesh.corner(i / 3, int(i % 3))));
      CHECK(glb.vector(normals, i).cwiseAbs().maxCoeff() == 1);  // along an axis
      CHECK(glb.vector(normals, i).dot(p - scale * Vector3f(0.55f, 1.1f, 1.65f)) > 0);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = std::size_t(axis);
      CHECK(glb.json.at("accessors").at(positions).at("min").at(k) == bounds.min()[axis]);
      CHECK(glb.json.at("accessors").at(positions).at("max").at(k) == bounds.max()[axis]);
    }
  }
}

TEST_CASE("colours are linear in glTF, and what is see-through is blended") {
  const Glb glb = written({{"red", box_mesh(), {1, 0.5f, 0}, 0.25f}, {"grey", box_mesh()}});
  const auto& red = glb.json.at("materials").at(0);
  const auto& factor = red.at("pbrMetallicRoughness").at("baseColorFactor");
  CHECK(factor.at(0).get<double>() == 1);
  CHECK(factor.at(1).get<double>() == doctest::Approx(0.214041).epsilon(1e-5));
  CHECK(factor.at(2).get<double>() == 0);
  CHECK(factor.at(3).get<double>() == 0.25);
  CHECK(red.at("alphaMode") == "BLEND");
  CHECK_FALSE(glb.json.at("materials").at(1).contains("alphaMode"));
}

TEST_CASE("a glTF that was written comes back to the bit, and stands") {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = box_mesh();
  write_glb(folder / "x.glb", {{"box", mesh}});
  const TriangleMesh read = read_mesh(folder / "x.glb");
  const TriangleMesh as_in_file = read_mesh(folder / "x.glb", {.unit_m = 1, .up = UpAxis::z});
  REQUIRE(read.triangles().size() == 12);
  for (std::size_t i = 0; i < 12; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vector3f p = mesh.corner(i, k);
      CHECK(read.corner(i, k) == p);
      CHECK(as_in_file.corner(i, k) == Vector3f(p.x(), p.z(), -p.y()));  // y up in the file
    }
  }
}

TEST_CASE("every mesh is a named node below the one that turns the world") {
  const Glb glb = written({{"a", box_mesh()}, {"none", TriangleMesh()}, {"b", box_mesh()}});
  const auto& nodes = glb.json.at("nodes");
  REQUIRE(nodes.size() == 3);
  CHECK(nodes.at(0).at("children") == nlohmann::json({1, 2}));
  CHECK(nodes.at(1).at("name") == "a");
  CHECK(nodes.at(2).at("name") == "b");
  CHECK(nodes.at(2).at("mesh") == 1);
  CHECK(glb.json.at("scenes").at(0).at("nodes") == nlohmann::json::array({0}));
}

TEST_CASE("a scene without triangles is a valid file") {
  const Glb glb = written({{"none", TriangleMesh()}});
  CHECK(glb.binary.empty());
  CHECK_FALSE(glb.json.contains("buffers"));
  CHECK_FALSE(glb.json.contains("meshes"));
  CHECK_FALSE(glb.json.at("nodes").at(0).contains("children"));
}

TEST_CASE("a name need not be UTF-8") {
  const Glb glb = written({{"caf\xe9", box_mesh()}});
  CHECK(glb.json.at("nodes").at(1).at("name") == "caf\xef\xbf\xbd");
}

TEST_CASE("a colour or an opacity outside 0 to 1 is refused") {
  const test::TemporaryFolder folder;
  const auto write = [&](const Vector3f& color, float opacity) {
    write_glb(folder / "a.glb", {{"cup", box_mesh(), color, opacity}});
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  test::expect_bad_input("mesh \"cup\"", "expected numbers from 0 to 1", [&] {
    write({2, 0, 0}, 1);
  });
  test::expect_bad_input("mesh \"cup\"", "nan", [&] { write({0, nan, 0}, 1); });
  test::expect_bad_input("mesh \"cup\"", "opacity -1", [&] { write({0, 0, 0}, -1); });
  test::expect_bad_input("none", "does not exist", [&] { write_glb(folder / "none/a.glb", {}); });
  CHECK(std::filesystem::is_empty(folder.path()));
}
