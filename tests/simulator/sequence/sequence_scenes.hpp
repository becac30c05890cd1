#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "simulator/sequence/random_sequence.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::test {

/// A cube of 5 cm with a marker on each side.
inline TypePtr marked_cube(const std::string& name, int first_id) {
  ObjectType type{name};
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.05, 0.05, 0.05}));
  for (int side = 0; side < 6; ++side) {
    const Eigen::Vector3d out = Eigen::Vector3d::Unit(side % 3) * (side < 3 ? 1 : -1);
    const Eigen::Vector3d up = Eigen::Vector3d::Unit(side % 3 == 2 ? 1 : 2);
    Eigen::Matrix3d rotation;
    rotation << up.cross(out), up, out;
    type.features.push_back(marker_feature(
        {"4X4_50", first_id + side, 0.04, Pose::from_rotation(rotation, 0.025 * out)}));
  }
  return std::make_shared<const ObjectType>(std::move(type));
}

inline SequenceCamera sequence_camera(const std::string& name, const Eigen::Vector3d& eye,
                                      const Eigen::Vector3d& target = {0, 0, 0}) {
  const Intrinsics k{640, 480, 615, 615, 319.5, 239.5};
  return {name, PinholeCamera(k, Pose::looking_at(eye, target)), Lens(k, {})};
}

/// A plate with six cubes of two types on it, and three cameras.
inline SequenceScene six_cubes() {
  const TypePtr types[] = {marked_cube("red", 0), marked_cube("blue", 6)};
  SequenceScene scene{.objects = {},
                      .floor = Box({-0.3, -0.2, 0}, {0.3, 0.2, 0.3}),
                      .obstacles = {},
                      .fixed = {},
                      .cameras = {sequence_camera("left", {-0.42, -0.4, 0.5}),
                                  sequence_camera("right", {0.42, -0.4, 0.5}),
                                  sequence_camera("back", {0, 0.55, 0.5})}};
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Pose pose =
        Pose::from_translation({0.15 * double(i % 3) - 0.15, i < 3 ? -0.1 : 0.1, 0.025});
    scene.objects.push_back({i + 1,
                             types[i % 2]->name + " " + std::to_string(i + 1),
                             types[i % 2],
                             {{.T_world_object = pose}}});
  }
  const auto plate = std::make_shared<const TriangleMesh>(
      TriangleMesh::from_box(Box({-0.4, -0.3, -0.01}, {0.4, 0.3, 0})));
  scene.fixed.push_back({"board", plate, {}});
  return scene;
}

}  // namespace vantage::test
