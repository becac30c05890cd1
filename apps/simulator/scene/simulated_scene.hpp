#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/scene/textured_mesh.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Something that really is in the simulated cell.
struct SimulatedBody {
  std::string name;
  std::shared_ptr<const TexturedMesh> shape;  ///< never null
  Pose T_world_body;
};

/// What simulated cameras look at: bodies, and the same bodies under a BVH. Immutable; may be read
/// from many threads at once.
class SimulatedScene {
 public:
  /// Builds the BVH. Bodies that share a shape of 500 triangles or more share its BVH too.
  /// @throws Error as `SceneBuilder` does; bad_input for a body without a shape, and for one whose
  /// texture coordinates are not one for each triangle.
  explicit SimulatedScene(std::vector<SimulatedBody> bodies);

  const std::vector<SimulatedBody>& bodies() const noexcept { return bodies_; }

  /// Object i of it is `bodies()[i]`.
  const Scene& rays() const noexcept { return *rays_; }

 private:
  std::vector<SimulatedBody> bodies_;
  std::shared_ptr<const Scene> rays_;
};

}  // namespace vantage
