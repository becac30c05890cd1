#pragma once

#include <string>

#include "vantage/raycore/pose.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {

/// An object that truly stands in the scene.
struct TrueObject {
  std::string name;
  TypePtr type;
  Pose T_world_object;
};

}  // namespace vantage
