#pragma once

#include <map>
#include <memory>
#include <vector>

#include "reconstruct/outline.hpp"
#include "reconstruct/scene_reconstruction.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Draws a reconstruction over the photographs that it was made of: outlines and names of objects,
/// corners that were explained and those that were not, how far off they are, and the world's axes.
class OverlayPainter {
 public:
  /// All three have to outlive the painter; `objects` are the reconstruction's, named.
  OverlayPainter(const BopScene& scene, const SceneReconstruction& reconstruction,
                 const std::vector<KnownObject>& objects);

  /// @param image an index of the scene's images, one that has a colour picture.
  /// @throws Error bad_input as `read_color` does.
  ColorImage paint(std::size_t image) const;

 private:
  const BopScene& scene_;
  const SceneReconstruction& reconstruction_;
  const std::vector<KnownObject>& objects_;
  std::map<const TriangleMesh*, std::vector<MeshEdge>> edges_;
  std::shared_ptr<const Scene> rays_;
};

}  // namespace vantage
