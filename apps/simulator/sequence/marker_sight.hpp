#pragma once

#include <array>
#include <optional>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage {

/// A camera of a simulated sequence.
struct SequenceCamera {
  std::string name;
  PinholeCamera camera;
  Lens lens;
};

/// How a camera sees a marker.
struct MarkerSight {
  std::array<Eigen::Vector2d, 4> corners_px;  ///< in the order of `Marker::corners`
  double recall = 0;                          ///< the detector's; see `detector_recall`
};

/// Nothing if it is turned away, reaches beyond the image, or if any of it, with half a cell of the
/// white around it, is hidden: rays over all of it decide, not only over its corners.
/// @param scene everything that stands there, the marker's object too.
std::optional<MarkerSight> see_marker(const Marker& marker, const Pose& T_world_object,
                                      const SequenceCamera& camera, const Scene& scene);

}  // namespace vantage
