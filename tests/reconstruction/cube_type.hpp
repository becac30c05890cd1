#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage::test {

/// A cube of 5 cm without features.
inline ObjectType cube_type(const std::string& name, std::vector<std::string> is_a = {}) {
  static const auto kMesh = std::make_shared<const TriangleMesh>(box_solid({0.05, 0.05, 0.05}));
  return {.name = name, .is_a = std::move(is_a), .mesh = kMesh};
}

/// A marker of 3 cm, by default on the cube's upper side.
inline ObjectFeature cube_marker(int id, const Eigen::Vector3d& at_m = {0, 0, 0.025}) {
  return marker_feature({"4X4_50", id, 0.03, Pose::from_translation(at_m)});
}

}  // namespace vantage::test
