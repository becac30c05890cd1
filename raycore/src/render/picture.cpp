#include "vantage/raycore/advanced/picture.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "render/picture_tile.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

using raycore::detail::PictureTile;

/// A pixel's samples are traced together, in one task.
constexpr int kMaxSamples = raycore::detail::LightBatch::kCapacity;

void check(const Scene& scene, std::span<const Material> materials, const PictureOptions& options) {
  if (materials.size() != scene.object_count()) {
    throw bad_input("picture", fmt::format("{} materials for {} objects", materials.size(),
                                           scene.object_count()));
  }
  const auto check_samples = [](const char* what, int value) {
    if (value >= 1 && value <= kMaxSamples) return;
    throw bad_input("picture", fmt::format("{} is {}; expected 1 to {}", what, value, kMaxSamples));
  };
  check_samples("samples_per_pixel", options.samples_per_pixel);
  check_samples("first_samples", options.first_samples);
}

/// How many tiles cover a number of pixels.
int tiles(int pixels) {
  return (pixels + PictureTile::kSide - 1) / PictureTile::kSide;
}

}  // namespace

std::uint64_t picture_steps(int width, int height) {
  return std::uint64_t(tiles(width)) * std::uint64_t(tiles(height));
}

std::optional<ColorImage> render_picture(const Scene& scene, std::span<const Material> materials,
                                         const PinholeCamera& camera, const PictureOptions& options,
                                         const StopToken& stop) {
  check(scene, materials, options);
  const raycore::detail::PictureSetup setup(scene, materials, camera, options);
  ColorImage image(camera.intrinsics().width, camera.intrinsics().height);
  const int columns = tiles(image.width);
  tbb::enumerable_thread_specific<raycore::detail::TileScratch> scratch;
  tbb::parallel_for(0, columns * tiles(image.height), [&](int tile) {
    if (stop.stop_requested()) return;
    const int left = tile % columns * PictureTile::kSide, top = tile / columns * PictureTile::kSide;
    PictureTile(setup, left, top, scratch.local()).draw(image);
    stop.advance(1);
  });
  if (stop.stop_requested()) return std::nullopt;
  return image;
}

}  // namespace vantage
