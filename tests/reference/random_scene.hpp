#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <random>

#include "reference/moller_trumbore.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::test {

/// Random numbers that are the same with every standard library, unlike its distributions.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * engine_() * 0x1p-32; }
  std::uint32_t below(std::uint32_t count) { return engine_() % count; }
  Eigen::Vector3d in_cube(double half);
  Eigen::Vector3d direction();
  Pose pose(double half);

 private:
  std::mt19937 engine_;
};

/// Closed: `levels` times every triangle of an icosahedron is split into four.
TriangleMesh icosphere(double radius, int levels);

/// A closed block of one metre whose upper side is a random height field of cells × cells squares.
TriangleMesh height_field_block(Random& random, std::uint32_t cells);

/// Triangles without any order.
TriangleMesh triangle_soup(Random& random, std::uint32_t count);

/// A scene and its twin. The first `box_count` objects are boxes.
struct RandomScene {
  std::shared_ptr<const Scene> scene;
  ReferenceScene reference;
  ObjectId box_count = 0;
};

/// About two metres wide: turned boxes, a soup, a height field, an empty mesh, and with
/// `with_instances` some instances of two shared meshes.
RandomScene random_scene(std::uint32_t seed, bool with_instances);

}  // namespace vantage::test
