#include "vantage/raycore/advanced/picture.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/pixel_tile.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// The light on a surface that faces the sun; the last part reaches the deepest corner.
constexpr float kSunShare = 0.60f, kSkyShare = 0.30f, kFillShare = 0.10f;
constexpr float kFarAway = 100.0f;  // metres; nothing that matters is farther

float to_linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

float to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Eigen::Vector3f to_linear(const Eigen::Vector3f& srgb) {
  return srgb.unaryExpr([](float c) { return to_linear(c); });
}

/// The radical inverse of i in a base: low-discrepancy numbers in [0, 1).
float radical_inverse(unsigned i, unsigned base) {
  double result = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) result += digit * (i % base);
  return float(result);
}

/// What each of the samples of a pixel does; the same for all pixels.
struct Sample {
  float du, dv;            ///< position in the pixel, -0.5 to 0.5
  Eigen::Vector3f to_sky;  ///< a direction over the hemisphere around z
  Eigen::Vector3f to_sun;  ///< a direction within the sun's disc
};

Eigen::Vector3f any_perpendicular(const Eigen::Vector3f& n) {
  return n.cross(std::abs(n.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX())
      .normalized();
}

/// A direction around z with density cos/π: skylight is then the mere share of such directions that
/// are unobstructed. u and v are in [0, 1).
Eigen::Vector3f over_hemisphere(float u, float v) {
  const float angle = 2 * std::numbers::pi_v<float> * u, radius = std::sqrt(v);
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(1e-4f, 1 - v))};
}

std::vector<Sample> make_samples(const PictureOptions& options) {
  const Eigen::Vector3f sun = options.to_sun.normalized();
  const Eigen::Vector3f side = any_perpendicular(sun), up = sun.cross(side);
  std::vector<Sample> samples;
  for (unsigned i = 0; i < unsigned(options.samples_per_pixel); ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * radical_inverse(i, 11);
    const float radius = options.sun_radius * std::sqrt(radical_inverse(i, 13));
    const Eigen::Vector3f offset = radius * (std::cos(angle) * side + std::sin(angle) * up);
    samples.push_back({radical_inverse(i, 2) - 0.5f, radical_inverse(i, 3) - 0.5f,
                       over_hemisphere(radical_inverse(i, 5), radical_inverse(i, 7)),
                       (sun + offset).normalized()});
  }
  return samples;
}

Eigen::Vector3f sky_direction(const Eigen::Vector3f& n, const Sample& sample) {
  const Eigen::Vector3f side = any_perpendicular(n), up = n.cross(side);
  return sample.to_sky.x() * side + sample.to_sky.y() * up + sample.to_sky.z() * n;
}

bool on_line(const Material& material, const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(n[axis]) > 0.7f) continue;  // a face that lies in such a plane itself
    const float x = (p[axis] - material.line_origin[axis]) / material.line_spacing_m;
    if (std::abs(x - std::round(x)) * material.line_spacing_m < 0.5f * material.line_width_m) {
      return true;
    }
  }
  return false;
}

/// Draws the bands of four pixel rows; each sample of a band is a wave of rays.
class Painter {
 public:
  Painter(const Scene& scene, std::span<const Material> materials, const PinholeCamera& camera,
          const PictureOptions& options)
      : scene_(scene),
        materials_(materials),
        camera_(camera),
        options_(options),
        samples_(make_samples(options)),
        background_(to_linear(options.background)) {
    for (const Material& material : materials) colors_.push_back(to_linear(material.color));
  }

  void paint(int band, ColorImage& image) const {
    const std::vector<raycore::detail::Pixel> pixels =
        raycore::detail::pixels_of_band(camera_.intrinsics(), band);
    std::vector<Eigen::Vector3f> light(pixels.size(), Eigen::Vector3f::Zero());
    for (const Sample& sample : samples_) add_sample(sample, pixels, light);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      std::uint8_t* out = image.pixel(pixels[i].u, pixels[i].v);
      for (int c = 0; c < 3; ++c) {
        const float mean = light[i][c] / float(samples_.size());
        out[c] = std::uint8_t(std::lround(255 * std::min(1.0f, to_srgb(mean))));
      }
    }
  }

 private:
  /// Surface points that one wave of rays has hit.
  struct Surface {
    std::vector<std::size_t> pixel;
    std::vector<Eigen::Vector3f> color, normal;
    std::vector<float> faded;  ///< 0 to 1
    Points from, to_sky, to_sun;
  };

  void add_sample(const Sample& sample, const std::vector<raycore::detail::Pixel>& pixels,
                  std::vector<Eigen::Vector3f>& light) const {
    Points directions(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const PixelRay ray = camera_.pixel_ray(pixels[i].u + sample.du, pixels[i].v + sample.dv);
      directions.set(i, ray.direction.normalized().cast<float>());
    }
    Hits hits;
    scene_.closest_hits(camera_.centre().cast<float>(), directions, hits, RayOrder::coherent);
    Surface surface;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (hits.hit(i)) {
        add_point(sample, directions[i], hits, i, surface);
      } else {
        light[i] += background_;
      }
    }
    add_light(surface, sample, light);
  }

  void add_point(const Sample& sample, const Eigen::Vector3f& direction, const Hits& hits,
                 std::size_t i, Surface& surface) const {
    const Material& material = materials_[hits.object[i]];
    Eigen::Vector3f normal = hits.normal[i];
    if (normal.dot(direction) > 0) normal = -normal;
    const Eigen::Vector3f hit = camera_.centre().cast<float>() + hits.t[i] * direction;
    const Eigen::Vector3f from = hit + 1e-4f * std::max(0.1f, hits.t[i]) * normal;
    const bool line = material.line_spacing_m > 0 && on_line(material, hit, normal);
    const float distance = (hit - material.fade_centre).norm();
    const bool fades = std::isfinite(material.fade_to_m);
    const float faded =
        fades ? (distance - material.fade_from_m) / (material.fade_to_m - material.fade_from_m)
              : 0.0f;
    surface.pixel.push_back(i);
    surface.color.push_back((line ? material.line_shade : 1.0f) * colors_[hits.object[i]]);
    surface.normal.push_back(normal);
    surface.faded.push_back(std::clamp(faded, 0.0f, 1.0f));
    surface.from.push_back(from);
    surface.to_sky.push_back(from + options_.sky_reach_m * sky_direction(normal, sample));
    surface.to_sun.push_back(from + kFarAway * sample.to_sun);
  }

  void add_light(const Surface& surface, const Sample& sample,
                 std::vector<Eigen::Vector3f>& light) const {
    std::vector<std::uint8_t> no_sky(surface.pixel.size()), no_sun(surface.pixel.size());
    scene_.occluded(surface.from, surface.to_sky, no_sky, RayOrder::coherent);
    scene_.occluded(surface.from, surface.to_sun, no_sun, RayOrder::coherent);
    for (std::size_t i = 0; i < surface.pixel.size(); ++i) {
      const float facing = std::max(0.0f, surface.normal[i].dot(sample.to_sun));
      const float share =
          kFillShare + (no_sky[i] ? 0.0f : kSkyShare) + (no_sun[i] ? 0.0f : kSunShare * facing);
      const Eigen::Vector3f reflected = 1.12f * share * surface.color[i];
      light[surface.pixel[i]] +=
          (1 - surface.faded[i]) * reflected + surface.faded[i] * background_;
    }
  }

  const Scene& scene_;
  std::span<const Material> materials_;
  const PinholeCamera& camera_;
  const PictureOptions& options_;
  std::vector<Sample> samples_;
  Eigen::Vector3f background_;           ///< linear, as are the colours
  std::vector<Eigen::Vector3f> colors_;  ///< of the materials
};

}  // namespace

std::optional<ColorImage> render_picture(const Scene& scene, std::span<const Material> materials,
                                         const PinholeCamera& camera, const PictureOptions& options,
                                         const StopToken& stop) {
  if (materials.size() != scene.object_count()) {
    throw bad_input("picture", fmt::format("{} materials for {} objects", materials.size(),
                                           scene.object_count()));
  }
  if (options.samples_per_pixel < 1 || options.samples_per_pixel > 4096) {
    throw bad_input("picture", fmt::format("{} samples per pixel; expected 1 to 4096",
                                           options.samples_per_pixel));
  }
  const Painter painter(scene, materials, camera, options);
  ColorImage image(camera.intrinsics().width, camera.intrinsics().height);
  tbb::parallel_for(std::size_t(0), raycore::detail::band_count(image.height),
                    [&](std::size_t band) {
                      if (!stop.stop_requested()) painter.paint(int(band), image);
                    });
  if (stop.stop_requested()) return std::nullopt;
  return image;
}

}  // namespace vantage
