#include "reference/random_scene.hpp"

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace vantage::test {

Eigen::Vector3d Random::in_cube(double half) {
  const double x = uniform(-half, half), y = uniform(-half, half);
  return {x, y, uniform(-half, half)};
}

Eigen::Vector3d Random::direction() {
  const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Pose Random::pose(double half) {
  const Eigen::Vector3d axis = direction();
  const double angle = uniform(0, 2 * std::numbers::pi);
  return Pose::from_rotation(Eigen::AngleAxisd(angle, axis).toRotationMatrix(), in_cube(half));
}

TriangleMesh icosphere(double radius, int levels) {
  const double g = std::numbers::phi;
  std::vector<Eigen::Vector3d> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                         {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                         {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Triangle> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), points.size());
      if (is_new) points.push_back((points[a].normalized() + points[b].normalized()));
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  std::vector<Eigen::Vector3f> vertices;
  for (const Eigen::Vector3d& p : points)
    vertices.push_back((radius * p.normalized()).cast<float>());
  return {std::move(vertices), std::move(faces)};
}

TriangleMesh height_field_block(Random& random, std::uint32_t cells) {
  const std::uint32_t side = cells + 1, below = side * side;
  std::vector<Eigen::Vector3f> vertices(2 * below);
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const float x = float(i) / float(cells) - 0.5f, y = float(j) / float(cells) - 0.5f;
      vertices[j * side + i] = {x, y, float(random.uniform(0.1, 0.4))};
      vertices[below + j * side + i] = {x, y, 0};
    }
  }
  std::vector<Triangle> faces;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  };
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * side + i; };
  for (std::uint32_t j = 0; j < cells; ++j) {
    quad(at(j, 0), below + at(j, 0), below + at(j + 1, 0), at(j + 1, 0));
    quad(at(j + 1, cells), below + at(j + 1, cells), below + at(j, cells), at(j, cells));
    quad(at(0, j + 1), below + at(0, j + 1), below + at(0, j), at(0, j));
    quad(at(cells, j), below + at(cells, j), below + at(cells, j + 1), at(cells, j + 1));
    for (std::uint32_t i = 0; i < cells; ++i) {
      quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      quad(below + at(i, j), below + at(i, j + 1), below + at(i + 1, j + 1), below + at(i + 1, j));
    }
  }
  return {std::move(vertices), std::move(faces)};
}

TriangleMesh triangle_soup(Random& random, std::uint32_t count) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> faces;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d centre = random.in_cube(1);
    for (int c = 0; c < 3; ++c) vertices.push_back((centre + random.in_cube(0.3)).cast<float>());
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(faces)};
}

RandomScene random_scene(std::uint32_t seed, bool with_instances) {
  Random random(seed);
  SceneBuilder builder;
  RandomScene result;
  result.box_count = random.below(5);
  for (ObjectId i = 0; i < result.box_count; ++i) {
    const Eigen::Vector3d half(random.uniform(0.02, 0.3), random.uniform(0.02, 0.3),
                               random.uniform(0.02, 0.3));
    const Box box(-half, half);
    const Pose T_world_box = random.pose(0.9);
    const ObjectId id = builder.add_box(box, T_world_box);
    result.reference.add(TriangleMesh::from_box(box), T_world_box, id);
  }
  const auto add = [&](const TriangleMesh& mesh) {
    result.reference.add(mesh, {}, builder.add_mesh(mesh));
  };
  add(triangle_soup(random, 1 + random.below(40)));
  add(TriangleMesh());
  add(height_field_block(random, 4).transformed(random.pose(0.5)));
  if (with_instances) {
    const std::shared_ptr<const TriangleMesh> shared[] = {
        std::make_shared<TriangleMesh>(icosphere(0.2, 1)),
        std::make_shared<TriangleMesh>(triangle_soup(random, 12))};
    for (std::uint32_t i = 0, count = 1 + random.below(8); i < count; ++i) {
      const auto& mesh = shared[random.below(2)];
      const Pose T_world_mesh = random.pose(0.9);
      result.reference.add(*mesh, T_world_mesh, builder.add_instance(mesh, T_world_mesh));
    }
  }
  result.scene = builder.build();
  return result;
}

}  // namespace vantage::test
