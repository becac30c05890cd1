#pragma once

#include <optional>
#include <vector>

#include "simulator/color/color_sensor.hpp"
#include "simulator/color/lamp.hpp"
#include "simulator/color/ray_block.hpp"
#include "simulator/color/sample_table.hpp"
#include "simulator/color/surface_color.hpp"
#include "vantage/raycore/lens.hpp"

namespace vantage {

/// Room to paint a band in. A task keeps one for all of its bands.
struct BandScratch {
  struct Pixel {
    int u, v;
    PixelRays rays;
    float brightness;  ///< what vignetting leaves
  };
  std::vector<Pixel> pixels;           ///< tile by tile
  std::vector<Eigen::Vector3f> light;  ///< linear, summed over the samples of each
  RayBlock block;
};

/// Paints bands of four pixel rows, of which a picture has `band_count()`. The samples of a band
/// are traced in blocks of fixed size, pixel by pixel and tile by tile: with 16 samples, a packet
/// of rays is one pixel, with one sample a tile of 4 × 4. Thread-safe; refers to its options.
class ColorPainter {
 public:
  ColorPainter(const SimulatedScene& scene, const Lighting& lighting, const PinholeCamera& camera,
               const ColorSensor& sensor, std::uint64_t seed);

  std::size_t band_count() const;
  void paint(std::size_t band, BandScratch& scratch, ColorImage& image) const;

 private:
  void list_pixels(int top, BandScratch& scratch) const;
  BandScratch::Pixel sight_of(int u, int v, Eigen::Vector2d& guess) const;
  void trace(BandScratch& scratch) const;
  void add_background(BandScratch& scratch) const;
  void add_sky(RayBlock& block) const;
  void add_lamp(RayBlock& block) const;
  void develop(const BandScratch& scratch, ColorImage& image) const;

  const Scene& rays_;
  const Lighting& lighting_;
  const PinholeCamera& camera_;
  const ColorSensor& sensor_;
  std::uint64_t seed_;
  SampleTable samples_;
  SurfaceColors colors_;
  Lamp lamp_;
  std::optional<Lens> lens_;    ///< nothing: pixels are where the pinhole has them
  Eigen::Vector3f background_;  ///< linear
};

}  // namespace vantage
