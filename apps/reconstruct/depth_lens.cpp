#include "reconstruct/depth_lens.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "reconstruct/calibration_list.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/rectify_depth.hpp"

namespace vantage {
namespace {

constexpr double kNotable_px = 1;  // what depth images can show at all

void rectify(const std::vector<Lens>& lenses, BopScene& scene) {
  tbb::parallel_for(std::size_t(0), scene.images.size(), [&](std::size_t i) {
    BopImage& image = scene.images[i];
    image.intrinsics = lenses[i].intrinsics();
    if (image.depth == nullptr || lenses[i].distortion().none()) return;
    image.depth =
        std::make_shared<const DepthImage>(rectify_depth(*image.depth, lenses[i], image.place));
  });
}

void warn_of_distortion(const std::vector<Lens>& lenses, BopScene& scene) {
  double largest_px = 0;
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    if (scene.images[i].depth == nullptr || lenses[i].distortion().none()) continue;
    if (i > 0 && lenses[i].distortion() == lenses[i - 1].distortion()) continue;
    largest_px = std::max(largest_px, max_displacement_px(lenses[i]));
  }
  if (largest_px <= kNotable_px) return;
  scene.warnings.push_back(fmt::format(
      "depth images are taken as a pinhole's, with the dataset's cam_K, but the calibration's lens "
      "displaces pixels by up to {:.1f}: if depth was registered to the distorted colour images, "
      "give --depth-lens calibrated; if it is rectified, --depth-lens pinhole (workcell: sensor: "
      "{{depth_lens: …}})",
      largest_px));
}

}  // namespace

void apply_depth_lens(DepthLens kind, const std::vector<std::filesystem::path>& calibrations,
                      BopScene& scene) {
  if (calibrations.empty() || kind == DepthLens::pinhole) return;
  const bool any_depth = std::ranges::any_of(
      scene.images, [](const BopImage& image) { return image.depth != nullptr; });
  if (!any_depth) return;
  const std::vector<Lens> lenses = lenses_of(scene, calibrations);
  if (kind == DepthLens::calibrated) {
    rectify(lenses, scene);
  } else {
    warn_of_distortion(lenses, scene);
  }
}

DepthLens depth_lens_of(const std::string& name, const std::string& where) {
  if (name == "auto") return DepthLens::unsaid;
  if (name == "pinhole") return DepthLens::pinhole;
  if (name == "calibrated") return DepthLens::calibrated;
  throw bad_input(where, fmt::format("found {}; expected auto, pinhole or calibrated", name));
}

}  // namespace vantage
