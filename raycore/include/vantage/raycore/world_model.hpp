#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// Something whose shape and pose are known: a reconstructed object or a static structure.
struct KnownObject {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;  ///< in the object's own frame; never null
  Pose T_world_object;
};

/// A camera that looks at the workcell, with what it measured if it measures depth.
struct Observer {
  std::string name;
  PinholeCamera camera;
  std::shared_ptr<const DepthImage> depth;  ///< null for a camera without depth
};

/// What is known of the workcell: where reconstruction and planning meet.
struct WorldModel {
  std::vector<KnownObject> objects;
  std::vector<KnownObject> static_structures;
  std::vector<Observer> cameras;
};

}  // namespace vantage
