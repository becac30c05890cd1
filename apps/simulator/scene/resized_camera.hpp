#pragma once

#include "vantage/raycore/camera.hpp"

namespace vantage {

/// The same camera with other pixels: its image covers the same directions.
inline PinholeCamera resized_camera(const PinholeCamera& camera, int width, int height) {
  const Intrinsics& k = camera.intrinsics();
  const double to_u = double(width) / k.width, to_v = double(height) / k.height;
  return PinholeCamera({width, height, to_u * k.fx, to_v * k.fy, to_u * (k.cx + 0.5) - 0.5,
                        to_v * (k.cy + 0.5) - 0.5},
                       camera.T_world_cam(), camera.range());
}

}  // namespace vantage
