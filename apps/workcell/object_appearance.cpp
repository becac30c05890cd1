#include "workcell/object_appearance.hpp"

#include <algorithm>

#include "simulator/markers/marker_print.hpp"

namespace vantage {

double texel_for(std::span<const Marker> markers) {
  constexpr double kTexelsAcross = 160;
  double smallest_m = 1;
  for (const Marker& marker : markers) smallest_m = std::min(smallest_m, marker.size_m);
  return smallest_m / kTexelsAcross;
}

std::shared_ptr<const TexturedMesh> ObjectLooks::of(const TypePtr& type) {
  std::shared_ptr<const TexturedMesh>& look = of_types_[type];
  if (look == nullptr) {
    const std::vector<Marker> markers = type->markers();
    look = std::make_shared<const TexturedMesh>(
        with_markers(*type->mesh, type->color, markers,
                     type->place.empty() ? type->name : type->place, texel_for(markers)));
  }
  return look;
}

std::shared_ptr<const TexturedMesh> ObjectLooks::of(const PlacedObject& object) {
  if (object.type != nullptr) return of(object.type);
  return std::make_shared<const TexturedMesh>(TexturedMesh{*object.mesh, object.color});
}

}  // namespace vantage
