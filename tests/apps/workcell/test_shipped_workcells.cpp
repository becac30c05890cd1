// The shipped scenes show what the thesis says of them, and could stand on a real table.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "simulator/placement/collision.hpp"
#include "support/scene_count.hpp"
#include "workcell/simulated_cell.hpp"

#include "apps/cell_files.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

Workcell shipped(const std::string& name) {
  Workcell cell = load_workcell(shipped_workcell(name));
  place_random_objects(cell);
  return cell;
}

const std::vector<std::string> kThesis{"castle", "corridor", "foreign_objects", "two_pillars",
                                       "wall"};

/// All that are not the thesis', but the board of a recording: nobody simulates that.
std::vector<std::string> other_names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(shipped_workcells())) {
    const std::string name = entry.path().stem();
    if (entry.path().extension() != ".yaml" || name == "charuco") continue;
    if (std::find(kThesis.begin(), kThesis.end(), name) == kThesis.end()) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// As many of the scenes as there is time for.
std::vector<std::string> some(std::vector<std::string> names) {
  names.resize(scene_count(std::uint32_t(names.size())));
  return names;
}

const PinholeCamera& camera_of(const Workcell& cell, const std::string& name) {
  const auto found = std::find_if(cell.cameras.begin(), cell.cameras.end(),
                                  [&](const CellCamera& camera) { return camera.name == name; });
  REQUIRE(found != cell.cameras.end());
  return found->camera;
}

/// The bodies that a camera sees, looking through every second pixel of every second row.
Names seen(const SimulatedCell& simulated, const PinholeCamera& camera) {
  std::vector<float> u, v;
  for (int row = 0; row < camera.intrinsics().height; row += 2) {
    for (int column = 0; column < camera.intrinsics().width; column += 2) {
      u.push_back(float(column)), v.push_back(float(row));
    }
  }
  Hits hits;
  simulated.scene.rays().closest_hits(camera.centre().cast<float>(), camera.pixel_directions(u, v),
                                      hits);
  Names names;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits.hit(i)) names.insert(simulated.bodies[hits.object[i]].name);
  }
  return names;
}

Names seen(const Workcell& cell, const std::string& camera_name) {
  return seen(simulated_cell(cell), camera_of(cell, camera_name));
}

bool has_all(const Names& names, std::initializer_list<const char*> wanted) {
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](const char* name) { return names.contains(name); });
}

bool has_any(const Names& names, std::initializer_list<const char*> wanted) {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](const char* name) { return names.contains(name); });
}

/// The mesh, a thousandth smaller around the middle of its bounding box.
TriangleMesh shrunk(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) bounds.extend(vertex.cast<double>());
  const Eigen::Vector3d middle = bounds.center();
  return mesh.transformed(Pose::from_translation(-middle))
      .scaled(0.999)
      .transformed(Pose::from_translation(middle));
}

/// What touches is free as soon as one of the two is a little smaller; what crosses is not.
struct Solid {
  std::string name;
  CollisionShape whole, smaller;
  Pose pose;
};

bool cross(const Solid& a, const Solid& b) {
  constexpr double kGap = 2e-6;
  return closer_than(kGap, a.whole, a.pose, b.smaller, b.pose) &&
         closer_than(kGap, a.smaller, a.pose, b.whole, b.pose);
}

std::vector<Solid> solids_of(const Workcell& cell) {
  std::vector<Solid> solids;
  const SimulatedCell simulated = simulated_cell(cell);
  for (const SimulatedBody& body : simulated.scene.bodies()) {
    const TriangleMesh& mesh = body.shape->mesh;
    solids.push_back(
        {body.name, CollisionShape(mesh), CollisionShape(shrunk(mesh)), body.T_world_body});
  }
  return solids;
}

/// Board markers that the camera sees as a whole.
int markers_seen(const Board& board, const Scene& rays, const CellCamera& camera) {
  int count = 0;
  for (const Marker& marker : board.markers) {
    const auto corners = marker.corners();
    count += std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
      const Eigen::Vector3f above = (corner + Eigen::Vector3d(0, 0, 1e-4)).cast<float>();
      return camera.camera.in_view(above) &&
             !rays.occluded(above, camera.camera.centre().cast<float>());
    });
  }
  return count;
}

/// The fewest whole markers of the board that a camera of the scene sees.
int fewest_markers_seen(const std::string& name) {
  const Workcell cell = shipped(name);
  REQUIRE(cell.board);
  REQUIRE(!cell.cameras.empty());
  const SimulatedCell simulated = simulated_cell(cell);
  int fewest = 1000;
  for (const CellCamera& camera : cell.cameras) {
    fewest = std::min(fewest, int(markers_seen(*cell.board, simulated.scene.rays(), camera)));
  }
  return fewest;
}

/// The pairs of things in a scene that cross each other.
Names crossings(const std::string& name) {
  const std::vector<Solid> solids = solids_of(shipped(name));
  REQUIRE(solids.size() >= 3);
  Names pairs;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (cross(solids[i], solids[j])) pairs.insert(solids[i].name + ", " + solids[j].name);
    }
  }
  return pairs;
}

}  // namespace

TEST_CASE("the thesis' scenes load, and their cameras see the board") {
  for (const std::string& name : some(kThesis)) CHECK_MESSAGE(fewest_markers_seen(name) >= 4, name);
}

TEST_CASE("all other scenes load, and their cameras see the board") {
  const std::vector<std::string> names = other_names();
  CHECK(names.size() >= 5);
  for (const std::string& name : some(names)) {
    const int expected = name == "example" ? 0 : 4;  // it has four markers only, to stay short
    CHECK_MESSAGE(fewest_markers_seen(name) >= expected, name);
  }
}

TEST_CASE("nothing in the thesis' scenes crosses another thing") {
  for (const std::string& name : some(kThesis)) CHECK_MESSAGE(crossings(name).empty(), name);
}

TEST_CASE("nothing in any other scene crosses another thing") {
  for (const std::string& name : some(other_names())) CHECK_MESSAGE(crossings(name).empty(), name);
}

TEST_CASE("known objects stand on something" * doctest::test_suite("slow")) {
  const std::vector<std::string> names{"bin", "castle", "corridor", "duck", "wall", "workcell"};
  for (const std::string& name : some(names)) {
    CAPTURE(name);
    const Workcell cell = shipped(name);
    std::vector<Solid> solids = solids_of(cell);
    const SimulatedCell simulated = simulated_cell(cell);
    for (std::size_t i = 0; i < solids.size(); ++i) {
      CAPTURE(solids[i].name);
      if (simulated.bodies[i].kind != BodyKind::known_object) continue;
      Solid lowered = solids[i];
      lowered.pose = Pose::from_translation({0, 0, -5e-4}) * lowered.pose;
      bool stands = false;
      for (std::size_t j = 0; j < solids.size(); ++j) {
        stands = stands || (i != j && cross(lowered, solids[j]));
      }
      CHECK(stands);
    }
  }
}

TEST_CASE("what crosses is found, what touches is not") {
  const TriangleMesh box = TriangleMesh::from_box(Box({0, 0, 0}, {1, 1, 1}));
  const auto at = [&](double x) {
    return Solid{"", CollisionShape(box), CollisionShape(shrunk(box)),
                 Pose::from_translation({x, 0, 0})};
  };
  CHECK(!cross(at(0), at(1)));
  CHECK(cross(at(0), at(0.99)));
}

TEST_CASE("wall: the front camera misses the red cube, the top camera what is underneath") {
  const Workcell cell = shipped("wall");
  CHECK(cell.known_objects.size() == 5);
  const Names front = seen(cell, "front"), top = seen(cell, "top");
  CHECK(has_all(front, {"blue", "magenta", "green", "yellow"}));
  CHECK(!front.contains("red"));
  CHECK(has_all(top, {"red", "green", "yellow"}));
  CHECK(!has_any(top, {"blue", "magenta"}));
  CHECK(seen(cell, "side").contains("red"));
}

TEST_CASE("corridor: each side sees its wall, only from above all is seen") {
  const Workcell cell = shipped("corridor");
  const Names left = seen(cell, "left"), right = seen(cell, "right");
  CHECK(has_all(left, {"red", "green", "blue", "magenta"}));
  CHECK(!has_any(left, {"yellow", "cyan", "gray"}));
  CHECK(has_all(right, {"yellow", "cyan", "orange", "purple"}));
  CHECK(!has_any(right, {"red", "green", "gray"}));
  CHECK(seen(cell, "front").contains("gray"));
  Names everything;
  for (const PlacedObject& object : cell.known_objects) everything.insert(object.name);
  const Names above = seen(cell, "above");
  CHECK(std::includes(above.begin(), above.end(), everything.begin(), everything.end()));
  // Elevated: nothing stands on the board but pedestals and the gray cube.
  for (const PlacedObject& object : cell.known_objects) {
    CHECK((object.T_world_object.translation().z() > 0.03) == (object.name != "gray"));
  }
}

TEST_CASE("two pillars: their shadows do not meet") {
  const Workcell cell = shipped("two_pillars");
  REQUIRE(cell.cameras.size() == 1);
  const SimulatedCell simulated = simulated_cell(cell);
  const Eigen::Vector3f eye = cell.cameras[0].camera.centre().cast<float>();
  std::vector<Eigen::Vector2f> left, right;
  for (float x = -0.25f; x <= 0.25f; x += 0.005f) {
    for (float y = -0.175f; y <= 0.175f; y += 0.005f) {
      const Eigen::Vector3f floor(x, y, 0);
      const auto hit = simulated.scene.rays().closest_hit({eye, floor - eye, 0, 0.999f});
      if (!hit || simulated.bodies[hit->object].kind != BodyKind::known_object) continue;
      const Pose& pose = simulated.scene.bodies()[hit->object].T_world_body;
      (pose.translation().x() < 0 ? left : right).push_back({x, y});
    }
  }
  CHECK(left.size() > 100);
  CHECK(right.size() > 100);
  float nearest = 1;
  for (const auto& a : left) {
    for (const auto& b : right) nearest = std::min(nearest, (a - b).norm());
  }
  CHECK(nearest > 0.05f);
}

TEST_CASE("foreign objects: in view, and nothing is known") {
  const Workcell cell = shipped("foreign_objects");
  CHECK(cell.known_objects.empty());
  CHECK(cell.cameras.size() == 1);
  CHECK(has_all(seen(cell, "front"), {"mug", "carton", "bottle", "palm"}));
}

TEST_CASE("castle: five cubes corner to corner, nine cameras") {
  const Workcell cell = shipped("castle");
  CHECK(cell.cameras.size() == 9);
  REQUIRE(cell.known_objects.size() == 5);
  const auto shared_corners = [](const KnownObject& a, const KnownObject& b) {
    int count = 0;
    for (const Eigen::Vector3f& p : a.mesh->vertices()) {
      for (const Eigen::Vector3f& q : b.mesh->vertices()) {
        count +=
            (a.T_world_object * p.cast<double>() - b.T_world_object * q.cast<double>()).norm() <
            1e-7;
      }
    }
    return count;
  };
  const std::map<Names, int> expected{{{"red", "green"}, 4},     {{"green", "blue"}, 4},
                                      {{"green", "yellow"}, 4},  {{"green", "purple"}, 4},
                                      {{"red", "purple"}, 2},    {{"blue", "purple"}, 2},
                                      {{"yellow", "purple"}, 2}, {{"red", "yellow"}, 2},
                                      {{"blue", "yellow"}, 2},   {{"red", "blue"}, 0}};
  const std::vector<KnownObject> cubes = known(cell.known_objects);
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      CAPTURE(cubes[i].name);
      CAPTURE(cubes[j].name);
      CHECK(shared_corners(cubes[i], cubes[j]) == expected.at({cubes[i].name, cubes[j].name}));
    }
  }
  // Each cube is seen from several sides.
  std::map<std::string, int> times;
  const SimulatedCell simulated = simulated_cell(cell);
  for (const CellCamera& camera : cell.cameras) {
    for (const std::string& name : seen(simulated, camera.camera)) ++times[name];
  }
  for (const KnownObject& cube : cubes) CHECK(times[cube.name] >= 3);
}

TEST_CASE("clutter: twenty objects of six types, several of each") {
  const Workcell cell = shipped("clutter");
  CHECK(cell.known_objects.size() == 20);
  std::map<std::string, int> counts;
  for (const PlacedObject& object : cell.known_objects) ++counts[object.type->name];
  CHECK(counts.size() == 6);
  for (const auto& [type, count] : counts) CHECK(count >= 3);
}

TEST_CASE("bin: its parts lie inside of it") {
  const Workcell cell = shipped("bin");
  CHECK(cell.known_objects.size() >= 5);
  for (const PlacedObject& object : cell.known_objects) {
    CAPTURE(object.name);
    for (const Eigen::Vector3f& vertex : object.mesh->vertices()) {
      const Eigen::Vector3d p = object.T_world_object * vertex.cast<double>();
      CHECK(Box({-0.185, -0.115, 0.005 - 1e-6}, {0.185, 0.115, 0.2}).contains(p));
    }
  }
}

TEST_CASE("the cell of 2 x 2 m has a camera in each corner") {
  const Workcell cell = shipped("workcell");
  Names quadrants;
  for (const CellCamera& camera : cell.cameras) {
    const Eigen::Vector3d at = camera.camera.centre();
    CHECK(std::min(std::abs(at.x()), std::abs(at.y())) > 0.8);
    quadrants.insert(std::string(at.x() > 0 ? "+" : "-") + (at.y() > 0 ? "+" : "-"));
  }
  CHECK(quadrants.size() == 4);
  CHECK(cell.known_objects.size() >= 4);
  CHECK(cell.static_structures.size() >= 10);
}

}  // namespace vantage::test
