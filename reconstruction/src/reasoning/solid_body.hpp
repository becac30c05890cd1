#pragma once

#include <memory>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::reconstruction::detail {

/// An object's body without its outermost layer, which a pose that is slightly off may put
/// anywhere.
class Body {
 public:
  /// The layer is `slack_m` thick, measured along the object's shortest side.
  Body(const ReconstructedObject& object, double slack_m);

  /// World frame; null if nothing is left of the body.
  std::shared_ptr<const Scene> scene() const;

  /// Empty if nothing is left of the body. World frame.
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
};

/// Whether two bodies share space beyond their outermost layers: a vertex or the middle of one lies
/// inside the other. Meshes that are not closed have no inside and overlap nothing.
bool overlap(const ReconstructedObject& a, const ReconstructedObject& b, double slack_m);

}  // namespace vantage::reconstruction::detail
