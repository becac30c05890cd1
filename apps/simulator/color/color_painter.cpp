#include "simulator/color/color_painter.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/color/ray_block.hpp"

namespace vantage {
namespace {

constexpr int kTileSide = 4;

}  // namespace

ColorPainter::ColorPainter(const SimulatedScene& scene, const Lighting& lighting,
                           const PinholeCamera& camera, const ColorSensor& sensor,
                           std::uint64_t seed)
    : rays_(scene.rays()),
      lighting_(lighting),
      camera_(camera),
      sensor_(sensor),
      seed_(seed),
      samples_(sensor.samples_per_pixel, seed),
      colors_(scene.bodies()),
      lamp_(lighting),
      background_(lighting.background.unaryExpr(&srgb_to_linear)) {
  if (sensor.distortion.none()) return;
  lens_.emplace(camera.intrinsics(), sensor.distortion);
  if (!lens_->covers_image()) lens_->sight(-0.5, -0.5, {});  // says which pixel looks too far aside
}

std::size_t ColorPainter::band_count() const {
  return std::size_t(camera_.intrinsics().height + kTileSide - 1) / kTileSide;
}

void ColorPainter::paint(std::size_t band, BandScratch& scratch, ColorImage& image) const {
  list_pixels(int(band) * kTileSide, scratch);
  scratch.light.assign(scratch.pixels.size(), Eigen::Vector3f::Zero());
  RayBlock& block = scratch.block;
  block.rays = 0;
  for (std::uint32_t pixel = 0; pixel < scratch.pixels.size(); ++pixel) {
    for (std::size_t first = 0; first < samples_.samples_per_pixel();) {
      const std::size_t last =
          std::min(samples_.samples_per_pixel(), first + kBlockRays - block.rays);
      add_rays(block, pixel, scratch.pixels[pixel].rays, samples_, first, last);
      if (block.rays == kBlockRays) trace(scratch);
      first = last;
    }
  }
  if (block.rays > 0) trace(scratch);
  develop(scratch, image);
}

void ColorPainter::list_pixels(int top, BandScratch& scratch) const {
  const Intrinsics& k = camera_.intrinsics();
  const int bottom = std::min(top + kTileSide, k.height);
  Eigen::Vector2d guess((0 - k.cx) / k.fx, (top - k.cy) / k.fy);
  scratch.pixels.clear();
  for (int left = 0; left < k.width; left += kTileSide) {
    const int right = std::min(left + kTileSide, k.width);
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) scratch.pixels.push_back(sight_of(u, v, guess));
    }
  }
}

/// `guess` is where a neighbour looks to, and then where this pixel does.
BandScratch::Pixel ColorPainter::sight_of(int u, int v, Eigen::Vector2d& guess) const {
  const Intrinsics& k = camera_.intrinsics();
  PixelSight sight;
  if (lens_) {
    sight = lens_->sight(u, v, guess);
    guess = sight.xy;
  } else {
    sight = {{(u - k.cx) / k.fx, (v - k.cy) / k.fy},
             Eigen::Vector2d(1 / k.fx, 1 / k.fy).asDiagonal()};
  }
  const Eigen::Matrix3d& rotation = camera_.T_world_cam().rotation();
  const Eigen::Matrix<double, 3, 2> per_pixel = rotation.leftCols<2>() * sight.per_pixel;
  const double cos2 = 1 / (1 + sight.xy.squaredNorm());
  const auto number = std::uint64_t(v) * std::uint64_t(k.width) + std::uint64_t(u);
  return {u,
          v,
          {(rotation * sight.xy.homogeneous()).cast<float>(), per_pixel.col(0).cast<float>(),
           per_pixel.col(1).cast<float>(), samples_.of_pixel(number)},
          float(1 - (1 - cos2 * cos2) * sensor_.vignetting)};
}

/// Traces the block's rays, adds their light to their pixels, and empties the block.
void ColorPainter::trace(BandScratch& scratch) const {
  RayBlock& block = scratch.block;
  const Eigen::Vector3f centre = camera_.centre().cast<float>();
  rays_.closest_hits(centre, block.direction.view(block.rays), block.hits, RayOrder::coherent);
  find_surfaces(block, centre);
  if (block.surfaces < block.rays) add_background(scratch);
  if (block.surfaces > 0) {
    add_sky(block);
    add_lamp(block);
  }
  const Hits& hits = block.hits;
  for (std::size_t s = 0; s < block.surfaces; ++s) {
    const std::size_t i = block.ray[s];
    scratch.light[block.pixel[i]] +=
        (block.sky_light[s] + block.lamp_light[s]) *
        colors_.at(hits.object[i], hits.triangle[i], hits.u[i], hits.v[i]);
  }
  block.rays = 0;
}

void ColorPainter::add_background(BandScratch& scratch) const {
  const RayBlock& block = scratch.block;
  for (std::size_t i = 0; i < block.rays; ++i) {
    if (!block.hits.hit(i)) scratch.light[block.pixel[i]] += background_;
  }
}

void ColorPainter::add_sky(RayBlock& block) const {
  aim_at_sky(block, lighting_.sky_reach_m);
  rays_.occluded(block.from.view(block.surfaces), block.to.view(block.surfaces),
                 {block.hidden, block.surfaces}, RayOrder::incoherent);
  const float open = lighting_.exposure * (1 - lighting_.lamp_share);
  const float light[] = {open, open * lighting_.bounce};
  for (std::size_t s = 0; s < block.surfaces; ++s) block.sky_light[s] = light[block.hidden[s]];
}

void ColorPainter::add_lamp(RayBlock& block) const {
  lamp_.unshadowed(block.from.view(block.surfaces), block.normal.view(block.surfaces),
                   block.lamp_light);
  aim_at_lamp(block, lamp_);
  rays_.occluded(block.lit_from.view(block.lit), block.lit_to.view(block.lit),
                 {block.hidden, block.lit}, RayOrder::coherent);
  for (std::size_t i = 0; i < block.lit; ++i) {
    if (block.hidden[i]) block.lamp_light[block.lit_surface[i]] = 0;
  }
}

/// From the sums of linear light to what the sensor puts out.
void ColorPainter::develop(const BandScratch& scratch, ColorImage& image) const {
  const double read_variance = sensor_.read_noise * sensor_.read_noise;
  const bool noisy = sensor_.read_noise > 0 || sensor_.shot_noise > 0;
  const float share = 1 / float(samples_.samples_per_pixel());
  for (std::size_t i = 0; i < scratch.pixels.size(); ++i) {
    const BandScratch::Pixel& pixel = scratch.pixels[i];
    std::uint8_t* out = image.pixel(pixel.u, pixel.v);
    const std::uint64_t first = std::uint64_t(out - image.samples.data());
    for (int c = 0; c < 3; ++c) {
      float signal = share * scratch.light[i][c] * pixel.brightness;
      if (noisy) {
        const double sigma = std::sqrt(read_variance + sensor_.shot_noise * double(signal));
        signal += float(sigma * to_normal(sample_hash(seed_, first + std::uint64_t(c))));
      }
      out[c] = linear_to_srgb8(signal);
    }
  }
}

}  // namespace vantage
