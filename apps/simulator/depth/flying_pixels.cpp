#include "simulator/depth/flying_pixels.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "simulator/scene/sample_hash.hpp"

namespace vantage::simulator::detail {
namespace {

constexpr float kJump = 0.02f;
constexpr std::uint64_t kPurpose = 1;  // other numbers than the noise of the same seed

class Mixer {
 public:
  Mixer(const std::vector<float>& metres, int width, int height)
      : metres_(metres), width_(width), height_(height) {}

  /// The neighbour that differs most in depth; the pixel's own depth if none jumps.
  float other_side(int u, int v) const {
    const float own = at(u, v);
    float other = own, widest = kJump * own;
    for (const auto& [du, dv] : kNeighbours) {
      const float z = at(u + du, v + dv);
      if (std::fabs(z - own) > widest) other = z, widest = std::fabs(z - own);
    }
    return other;
  }

  float at(int u, int v) const {
    if (u < 0 || v < 0 || u >= width_ || v >= height_) return std::nanf("");
    return metres_[std::size_t(v) * std::size_t(width_) + std::size_t(u)];
  }

 private:
  static constexpr std::array<std::array<int, 2>, 4> kNeighbours{
      {{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const std::vector<float>& metres_;
  int width_, height_;
};

}  // namespace

void add_flying_pixels(std::vector<float>& metres, int width, int height, double share,
                       std::uint64_t seed) {
  const std::vector<float> before = metres;
  const Mixer mixer(before, width, height);
  tbb::parallel_for(0, height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      const float own = mixer.at(u, v), other = mixer.other_side(u, v);
      if (!(own != other) || std::isnan(own)) continue;
      const std::size_t pixel = std::size_t(v) * std::size_t(width) + std::size_t(u);
      const std::uint64_t chance = sample_hash(seed, kPurpose, pixel);
      if (to_unit(chance) >= share) continue;
      const double weight = to_unit(scatter(chance));
      metres[pixel] = float(1 / ((1 - weight) / double(own) + weight / double(other)));
    }
  });
}

}  // namespace vantage::simulator::detail
