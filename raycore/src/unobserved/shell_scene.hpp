#pragma once

#include "scene/embree.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// A closed surface in the world as an Embree scene: its triangles look outwards, so that a ray
/// that meets the back of one first is inside, and all others are outside.
class ShellScene {
 public:
  ShellScene(const EmbreeDevice& device, const TriangleMesh& shell);
  RTCScene get() const { return scene_.get(); }

 private:
  OwnedScene scene_;
};

}  // namespace vantage::raycore::detail
