#include "simulator/color/color_sensor.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <memory>

#include "simulator/color/color_painter.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr double kFarthestLamp = 1e6;  // metres, as for vertices

void check(const char* where, const char* what, double value, double low, double high,
           const char* expected) {
  if (value >= low && value <= high) return;
  throw bad_input(where, fmt::format("{} is {}; expected {}", what, value, expected));
}

void check_point(const char* what, const Eigen::Vector3f& p) {
  for (const float x : p) {
    check("lighting", what, x, -kFarthestLamp, kFarthestLamp,
          "coordinates within 1e6 m of the origin");
  }
}

void check(const Lighting& lighting) {
  constexpr double kMin = 1e-6;
  check_point("a coordinate of lamp_centre_m", lighting.lamp_centre_m);
  check_point("a coordinate of lamp_target_m", lighting.lamp_target_m);
  check("lighting", "the distance from lamp_centre_m to lamp_target_m",
        (lighting.lamp_centre_m - lighting.lamp_target_m).norm(), kMin, 4 * kFarthestLamp,
        "more than 1e-6 m");
  check("lighting", "lamp_side_m", lighting.lamp_side_m, kMin, kFarthestLamp, "1e-6 to 1e6 m");
  check("lighting", "lamp_share", lighting.lamp_share, 0, 1, "0 to 1");
  check("lighting", "exposure", lighting.exposure, 0, 1e6, "0 to 1e6");
  check("lighting", "bounce", lighting.bounce, 0, 1, "0 to 1");
  check("lighting", "sky_reach_m", lighting.sky_reach_m, kMin, kFarthestLamp, "1e-6 to 1e6 m");
  for (const float c : lighting.background) {
    check("lighting", "a channel of background", c, 0, 1, "sRGB from 0 to 1");
  }
}

void check(const ColorSensor& sensor) {
  check("color sensor", "samples_per_pixel", sensor.samples_per_pixel, 1, 4096, "1 to 4096");
  check("color sensor", "vignetting", sensor.vignetting, 0, 1, "0 to 1");
  check("color sensor", "read_noise", sensor.read_noise, 0, 1, "0 to 1");
  check("color sensor", "shot_noise", sensor.shot_noise, 0, 1, "0 to 1");
}

}  // namespace

std::optional<ColorImage> simulate_color(const SimulatedScene& scene, const Lighting& lighting,
                                         const PinholeCamera& camera, const ColorSensor& sensor,
                                         std::uint64_t seed, const StopToken& stop) {
  check(lighting);
  check(sensor);
  const ColorPainter painter(scene, lighting, camera, sensor, seed);
  ColorImage image(camera.intrinsics().width, camera.intrinsics().height);
  const std::size_t bands = painter.band_count();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bands), [&](const auto& part) {
    const auto scratch = std::make_unique<BandScratch>();  // large: not for the stack
    for (std::size_t band = part.begin(); band < part.end(); ++band) {
      if (stop.stop_requested()) return;
      painter.paint(band, *scratch, image);
    }
  });
  if (stop.stop_requested()) return std::nullopt;
  return image;
}

}  // namespace vantage
