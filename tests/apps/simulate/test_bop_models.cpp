#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "simulate/bop_models.hpp"
#include "simulator/markers/marker_print.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

double volume_of(const TriangleMesh& mesh) {
  double six = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto at = [&](int corner) -> Eigen::Vector3d {
      return mesh.corner(t, corner).cast<double>();
    };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return six / 6;
}

/// The larger of both meshes' largest distance from a vertex to the other's nearest.
double vertex_distance_m(const TriangleMesh& a, const TriangleMesh& b) {
  const auto farthest = [](const TriangleMesh& from, const TriangleMesh& to) {
    double most = 0;
    for (const Eigen::Vector3f& p : from.vertices()) {
      double least = 1;
      for (const Eigen::Vector3f& q : to.vertices()) {
        least = std::min(least, (p.cast<double>() - q.cast<double>()).norm());
      }
      most = std::max(most, least);
    }
    return most;
  };
  return std::max(farthest(a, b), farthest(b, a));
}

BopModel cube(int id) {
  const Marker marker{"4X4_50", 3, 0.04, Pose::from_translation({0, 0, 0.025})};
  return {id,
          "cube",
          std::make_shared<const TexturedMesh>(with_markers(
              box_solid({0.05, 0.05, 0.05}), {0.8f, 0.1f, 0.1f}, {&marker, 1}, "cube")),
          {{Pose::from_rotation(
               Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0.01, 0, 0})},
           {}}};
}

BopModel tin(int id) {
  return {id,
          "tin",
          std::make_shared<const TexturedMesh>(TexturedMesh{cylinder_solid(0.03, 0.08)}),
          {{}, {{Eigen::Vector3d::UnitZ(), {0, 0, 0.001}}}}};
}

}  // namespace

TEST_CASE("models are written in millimetres, with what models_info.json has to say") {
  const test::TemporaryFolder folder;
  write_bop_models(folder.path(), {cube(1), tin(2)});
  const TriangleMesh read = read_mesh(folder / "obj_000001.ply", 0.001);
  CHECK(volume_of(read) == doctest::Approx(1.25e-4).scale(0).epsilon(1e-6));
  CHECK(volume_of(read_mesh(folder / "obj_000002.ply", 0.001)) ==
        doctest::Approx(M_PI * 0.03 * 0.03 * 0.08).scale(0).epsilon(0.01));
  CHECK(std::filesystem::is_regular_file(folder / "obj_000001.png"));
  CHECK_FALSE(std::filesystem::exists(folder / "obj_000002.png"));

  const auto info = nlohmann::json::parse(test::read_text(folder / "models_info.json"));
  CHECK(info.size() == 2);
  const auto& box = info["1"];
  CHECK(box["diameter"].get<double>() == doctest::Approx(50 * std::sqrt(3.0)).epsilon(1e-6));
  for (const char* axis : {"x", "y", "z"}) {
    CHECK(box[std::string("min_") + axis].get<double>() == doctest::Approx(-25).epsilon(1e-6));
    CHECK(box[std::string("size_") + axis].get<double>() == doctest::Approx(50).epsilon(1e-6));
  }
  const std::vector<double> turn = box["symmetries_discrete"][0];
  REQUIRE(turn.size() == 16);
  CHECK(turn[0] == doctest::Approx(-1));
  CHECK(turn[5] == doctest::Approx(-1));
  CHECK(turn[10] == doctest::Approx(1));
  CHECK(turn[3] == doctest::Approx(10));  // mm
  CHECK(turn[15] == 1);
  CHECK_FALSE(box.contains("symmetries_continuous"));
  const auto& round = info["2"]["symmetries_continuous"][0];
  CHECK(round["axis"] == nlohmann::json({0.0, 0.0, 1.0}));
  CHECK(round["offset"] == nlohmann::json({0.0, 0.0, 1.0}));
  CHECK(info["2"]["diameter"].get<double>() == doctest::Approx(100).epsilon(1e-6));
}

TEST_CASE("what was written comes back as a knowledge base") {
  const test::TemporaryFolder folder;
  const std::vector<BopModel> written{cube(1), tin(12)};
  write_bop_models(folder.path(), written);
  const FileKnowledgeBase base({folder.path()});
  REQUIRE(base.types().size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const ObjectType& type = *base.types()[i];
    const BopModel& model = written[i];
    CAPTURE(type.name);
    CHECK(type.bop_id == model.id);
    CHECK(vertex_distance_m(*type.mesh, model.shape->mesh) < 1e-9);
    CHECK(volume_of(*type.mesh) ==
          doctest::Approx(volume_of(model.shape->mesh)).scale(0).epsilon(1e-6));
    REQUIRE(type.symmetries.discrete.size() == model.symmetries.discrete.size());
    for (std::size_t s = 0; s < model.symmetries.discrete.size(); ++s) {
      const Pose &is = type.symmetries.discrete[s], &was = model.symmetries.discrete[s];
      CHECK((is.rotation() - was.rotation()).norm() < 1e-12);
      CHECK((is.translation() - was.translation()).norm() < 1e-12);
    }
    REQUIRE(type.symmetries.continuous.size() == model.symmetries.continuous.size());
    for (std::size_t s = 0; s < model.symmetries.continuous.size(); ++s) {
      const ContinuousSymmetry &is = type.symmetries.continuous[s],
                               &was = model.symmetries.continuous[s];
      CHECK((is.axis - was.axis).norm() < 1e-12);
      CHECK((is.offset_m - was.offset_m).norm() < 1e-12);
    }
  }
}

TEST_CASE("types that come from BOP models keep their ids, the others get those that are free") {
  const auto mesh = std::make_shared<const TriangleMesh>(box_solid({1, 1, 1}));
  const auto own = std::make_shared<const TriangleMesh>(box_solid({1, 1, 2}));
  const auto typed = [&](const char* name, std::optional<int> id) {
    return ObjectType{.name = name, .mesh = mesh, .bop_id = id};
  };
  Workcell cell{.work_area = Box({0, 0, 0}, {1, 1, 1})};
  cell.knowledge = std::make_shared<const MemoryKnowledgeBase>(
      std::vector<ObjectType>{typed("a", {}), typed("b", 2), typed("c", {}), typed("d", 7)});
  const TypePtr c = cell.knowledge->find("c");
  cell.known_objects = {{"first", mesh, {}, c}, {"own", own}};
  const std::vector<BopModel> models = bop_models(cell);
  const std::vector<std::pair<std::string, int>> expected{
      {"a", 1}, {"b", 2}, {"c", 3}, {"d", 7}, {"own", 4}};
  REQUIRE(models.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(models[i].name == expected[i].first);
    CHECK(models[i].id == expected[i].second);
  }
  CHECK(model_of(models, cell.known_objects[0]).name == "c");  // all have one mesh
  CHECK(model_of(models, cell.known_objects[1]).name == "own");
}

TEST_CASE("a textured model's vertices lead to the colours that it has") {
  const BopModel model = cube(1);
  const std::string text = bop_ply(*model.shape, "cube", "obj_000001.png");
  CHECK(text.find("comment TextureFile obj_000001.png\n") != std::string::npos);
  CHECK(text.find("property float texture_u\nproperty float texture_v\n") != std::string::npos);
  CHECK(text.find("property uchar red") == std::string::npos);
  // A corner of a side without a marker: its texture shows the cube's own red.
  std::size_t checked = 0;
  for (std::size_t t = 0; t < model.shape->uv.size(); ++t) {
    const bool top = std::fabs(model.shape->mesh.corner(t, 0).z() - 0.025f) < 1e-6f &&
                     std::fabs(model.shape->mesh.corner(t, 1).z() - 0.025f) < 1e-6f &&
                     std::fabs(model.shape->mesh.corner(t, 2).z() - 0.025f) < 1e-6f;
    if (top) continue;
    const auto& uv = model.shape->uv[t];
    const Eigen::Vector2f centre = (uv[0] + uv[1] + uv[2]) / 3;
    const std::uint8_t* p = model.shape->texture.pixel(int(centre.x()), int(centre.y()));
    CHECK(int(p[0]) == 204);
    CHECK(int(p[1]) == 26);
    ++checked;
  }
  CHECK(checked == 10);
}

}  // namespace vantage
