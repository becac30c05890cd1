#include "vantage/raycore/depth_image.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "vantage/raycore/detail/multiversion.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::size_t checked_count(int width, int height, std::string_view where) {
  if (width < 1 || height < 1) {
    throw bad_input(std::string(where), fmt::format("the image is {}×{} pixels; expected at least "
                                                    "one pixel",
                                                    width, height));
  }
  return std::size_t(width) * std::size_t(height);
}

/// Zero and infinity become unknown.
/// @returns whether no depth is negative.
[[gnu::always_inline]] inline bool mark_unknown_body(float* metres, std::size_t size) {
  int negative = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const float z = metres[i];
    negative |= int(z < 0);
    const bool unknown = (z == 0) | (z > std::numeric_limits<float>::max());
    metres[i] = unknown ? DepthImage::kUnknown : z;
  }
  return negative == 0;
}
constexpr Multiversion<mark_unknown_body> mark_unknown;

[[noreturn]] void refuse_negative(std::span<const float> metres, int width,
                                  std::string_view where) {
  std::size_t i = 0;
  while (!(metres[i] < 0)) ++i;
  throw bad_input(std::string(where),
                  fmt::format("pixel ({}, {}) has the depth {} m; expected 0 or more",
                              i % std::size_t(width), i / std::size_t(width), metres[i]));
}

}  // namespace

DepthImage::DepthImage(int width, int height)
    : width_(width), height_(height), metres_(checked_count(width, height, "depth"), kUnknown) {}

DepthImage::DepthImage(int width, int height, std::vector<float> metres, std::string_view where)
    : width_(width), height_(height), metres_(std::move(metres)) {
  if (metres_.size() != checked_count(width, height, where)) {
    throw bad_input(std::string(where),
                    fmt::format("{} depths for {}×{} pixels", metres_.size(), width, height));
  }
  if (!mark_unknown(metres_.data(), metres_.size())) refuse_negative(metres_, width, where);
}

DepthImage DepthImage::from_counts(const RawDepthImage& counts, double depth_scale_mm,
                                   std::string_view where) {
  if (!(std::isfinite(depth_scale_mm) && depth_scale_mm > 0)) {
    throw bad_input(
        std::string(where),
        fmt::format("the depth scale is {} mm; expected a number above 0", depth_scale_mm));
  }
  const double scale_m = depth_scale_mm / 1000;
  std::vector<float> metres(counts.samples.size());
  for (std::size_t i = 0; i < metres.size(); ++i) {
    const std::uint16_t count = counts.samples[i];
    metres[i] = count == kSaturatedCount ? kUnknown : float(count * scale_m);
  }
  return {counts.width, counts.height, std::move(metres), where};
}

PosedDepth::PosedDepth(const PinholeCamera& cam, std::shared_ptr<const DepthImage> image,
                       std::string_view where)
    : camera(cam), depth(std::move(image)) {
  if (depth == nullptr) throw bad_input(std::string(where), "there is no depth image");
  const Intrinsics& k = camera.intrinsics();
  if (depth->width() == k.width && depth->height() == k.height) return;
  throw bad_input(std::string(where),
                  fmt::format("the depth image is {}×{}, the intrinsics are for {}×{} pixels",
                              depth->width(), depth->height(), k.width, k.height));
}

}  // namespace vantage
