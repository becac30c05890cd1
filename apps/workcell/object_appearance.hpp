#pragma once

#include <map>
#include <memory>
#include <span>

#include "simulator/scene/textured_mesh.hpp"
#include "workcell/workcell_objects.hpp"

namespace vantage {

/// How finely to print markers: at 160 texels along the smallest one's edge, a camera that sees it
/// well enough sees no texels.
double texel_for(std::span<const Marker> markers);

/// What objects look like: their mesh in their colour, with their type's markers printed on it.
/// Prints once for each type. Not for many threads at once.
class ObjectLooks {
 public:
  /// Shared by all objects of the type.
  /// @throws Error bad_input as `with_markers`, with the type's place.
  std::shared_ptr<const TexturedMesh> of(const TypePtr& type);

  /// Its type's, or its own mesh in its own colour.
  std::shared_ptr<const TexturedMesh> of(const PlacedObject& object);

 private:
  std::map<TypePtr, std::shared_ptr<const TexturedMesh>> of_types_;
};

}  // namespace vantage
