#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "simulator/depth/depth_sensor.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::simulator::detail {

/// Rows of the image that are traced together; the image is cut into bands of these.
inline constexpr int kBandRows = 4;

/// The exact depth of what a stereo camera finds: seen by both imagers, lit by the projector, not
/// too slanted, not at the image's border. Thread-safe.
class StereoView {
 public:
  StereoView(const Scene& scene, const PinholeCamera& camera, const StereoSensor& sensor);

  /// Working memory of one thread.
  class Scratch;

  /// Fills the band's rows of a whole image, row-major; NaN where nothing is found.
  void fill_band(int band, Scratch& scratch, float* metres) const;

  /// Everything of the camera and the sensor that kernels need, in single precision.
  struct Numbers {
    Eigen::Vector3f centre, across, down, corner;  ///< ray = corner + u · across + v · down
    float near_m, far_m;
    float shift_m_px;  ///< fx · baseline: disparity in the image's own pixels, times depth
    float first_u, last_u, first_v, last_v;  ///< columns and rows that are not border
    float min_cosine_squared;  ///< of the angle between normal and ray; below 0: no limit
  };

 private:
  void fill_chunk(int first_u, int first_v, Scratch& scratch, float* metres) const;
  void lay_out(int first_u, int first_v, const float* depth, float* metres) const;
  void hide_from(const Eigen::Vector3f& origin, std::size_t tiles, Scratch& scratch) const;

  const Scene& scene_;
  int width_, height_;
  Numbers numbers_;
  bool second_imager_, projector_;
  Eigen::Vector3f second_centre_, projector_centre_;
};

/// Pixels that are traced together: tiles of 4 × 4, each a packet of 16 rays, side by side. Rays of
/// a tile stay together in the BVH.
inline constexpr int kChunkTiles = 64;
inline constexpr std::size_t kChunkRays = 16 * kChunkTiles;

class StereoView::Scratch {
 public:
  Scratch() : directions(kChunkRays), from(kChunkRays) {}

  std::array<float, kChunkRays> u, v, depth;
  Points directions, from;
  Hits hits;
  std::array<std::uint8_t, kChunkRays> blocked;
  std::array<std::uint8_t, kChunkTiles> tiles;  ///< in which anything is found
};

}  // namespace vantage::simulator::detail
