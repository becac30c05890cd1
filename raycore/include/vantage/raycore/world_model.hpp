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

/// Another explanation of an object: another pose, or another type.
struct AlternativeObject {
  std::string type;
  std::shared_ptr<const TriangleMesh> mesh;  ///< never null
  Pose T_world_object;
  double probability = 0;
};

/// Something whose shape and pose are known: a reconstructed object or a static structure.
struct KnownObject {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;  ///< in the object's own frame; never null
  Pose T_world_object;
  std::string type = {};                    ///< the knowledge base's name; empty if it has none
  std::optional<Matrix6d> covariance = {};  ///< of T_world_object; none: the pose was not measured
  double probability = 1;                   ///< probability of this type and pose
  std::vector<AlternativeObject> alternatives = {};  ///< likeliest first
};

/// A camera that looks at the workcell, with what it measured if it measures depth.
struct DepthCamera {
  std::string name;
  PinholeCamera camera;
  std::shared_ptr<const DepthImage> depth;  ///< null for a camera without depth
};

/// What is known about the workcell: the interface between reconstruction and planning.
struct WorldModel {
  std::vector<KnownObject> objects;
  std::vector<KnownObject> static_structures;
  std::vector<DepthCamera> cameras;
};

}  // namespace vantage
