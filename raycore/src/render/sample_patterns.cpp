#include "render/sample_patterns.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

namespace vantage::raycore::detail {
namespace {

constexpr int kPatterns = SamplePatterns::kSide * SamplePatterns::kSide;
enum Purpose : std::uint32_t { kSky = 1, kSun = 2 };

/// Point i of the (0, 2)-sequence, both coordinates as 32 bits after the point: any 2^k points from
/// a multiple of 2^k on are one to each elementary interval (Kollig, Keller, 2002).
struct BitPoint {
  std::uint32_t x = 0, y = 0;
};

BitPoint sobol_point(std::uint32_t i) {
  BitPoint p;
  for (std::uint32_t bit = 1u << 31, row = 1u << 31; i > 0; i >>= 1, bit >>= 1, row ^= row >> 1) {
    if (i & 1) p.x ^= bit, p.y ^= row;
  }
  return p;
}

double to_unit(std::uint32_t bits) {
  return bits * 0x1p-32;
}

/// Scatters the bits of a key (SplitMix64's finaliser).
std::uint32_t hash(std::uint64_t key) {
  key = (key + 0x9E3779B97F4A7C15u) * 0xBF58476D1CE4E5B9u;
  key = (key ^ (key >> 27)) * 0x94D049BB133111EBu;
  return std::uint32_t((key ^ (key >> 31)) >> 16);
}

/// The points of one pattern, shifted by an exclusive or, which keeps their intervals, and
/// shuffled.
std::vector<Eigen::Vector2d> points_of_pattern(Purpose purpose, int pattern, int samples) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < samples; ++i) {
    const BitPoint p = sobol_point(std::uint32_t(pattern * samples + i));
    points.emplace_back(to_unit(p.x ^ hash(purpose)), to_unit(p.y ^ hash(16 + purpose)));
  }
  for (int left = samples; left > 1; --left) {  // Fisher and Yates
    const std::uint64_t key = (std::uint64_t(purpose) << 40) + (std::uint64_t(pattern) << 20);
    std::swap(points[std::size_t(left - 1)], points[hash(key + std::uint64_t(left)) % left]);
  }
  return points;
}

Eigen::Vector3f over_hemisphere(const Eigen::Vector2d& p) {
  const double angle = 2 * std::numbers::pi * p.x(), radius = std::sqrt(p.y());
  return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle),
                         std::sqrt(std::max(1e-4, 1 - p.y())))
      .cast<float>();
}

/// A disc around the direction to the sun.
class SunDisc {
 public:
  explicit SunDisc(const PictureOptions& options)
      : radius_(options.sun_radius),
        sun_(options.to_sun.normalized()),
        side_(sun_.unitOrthogonal()),
        up_(sun_.cross(side_)) {}

  Eigen::Vector3f at(const Eigen::Vector2d& p) const {
    const float angle = float(2 * std::numbers::pi * p.x());
    const float radius = radius_ * float(std::sqrt(p.y()));
    return (sun_ + radius * (std::cos(angle) * side_ + std::sin(angle) * up_)).normalized();
  }

 private:
  float radius_;
  Eigen::Vector3f sun_, side_, up_;
};

}  // namespace

SamplePatterns::SamplePatterns(int samples, const PictureOptions& options) {
  const double half_step = 0.5 / double(std::bit_ceil(std::uint32_t(samples)));
  for (int i = 0; i < samples; ++i) {
    const BitPoint p = sobol_point(std::uint32_t(i));
    positions_.emplace_back(float(to_unit(p.x) + half_step - 0.5),
                            float(to_unit(p.y) + half_step - 0.5));
  }
  const SunDisc sun(options);
  for (int pattern = 0; pattern < kPatterns; ++pattern) {
    const std::vector<Eigen::Vector2d> to_sky = points_of_pattern(kSky, pattern, samples);
    const std::vector<Eigen::Vector2d> to_sun = points_of_pattern(kSun, pattern, samples);
    for (std::size_t i = 0; i < to_sky.size(); ++i) {
      light_.push_back({over_hemisphere(to_sky[i]), sun.at(to_sun[i])});
    }
  }
}

}  // namespace vantage::raycore::detail
