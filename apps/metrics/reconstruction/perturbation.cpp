#include "metrics/reconstruction/perturbation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// What a random number is for; each has its own.
enum class Draw { drop, misread, key, noise };

void check_share(double share, const char* name) {
  if (share >= 0 && share <= 1) return;
  throw bad_input(name, fmt::format("found {}; expected a share from 0 to 1", share));
}

/// Another key that the detector knows, or `key` if there is none.
FeatureKey misread(const FeatureKey& key, std::span<const FeatureKey> keys, std::uint64_t hash) {
  std::vector<const FeatureKey*> others;
  for (const FeatureKey& other : keys) {
    if (other.type == key.type && other != key) others.push_back(&other);
  }
  return others.empty() ? key : *others[hash % others.size()];
}

void add_noise(SeenPoints& seen, double noise_px, std::uint64_t hash) {
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      seen.pixels[i][axis] += noise_px * to_normal(sample_hash(hash, i, axis));
    }
  }
  seen.sigma_px = std::hypot(seen.sigma_px, noise_px);
}

}  // namespace

void Perturbation::check() const {
  if (!(noise_px >= 0) || !std::isfinite(noise_px)) {
    throw bad_input("noise_px", fmt::format("found {}; expected pixels, 0 or more", noise_px));
  }
  check_share(drop, "drop");
  check_share(wrong_ids, "wrong_ids");
}

std::vector<CameraView> disturbed(std::span<const CameraView> views,
                                  const Perturbation& perturbation, std::uint64_t trial,
                                  std::span<const FeatureKey> keys) {
  perturbation.check();
  std::vector<CameraView> result(views.begin(), views.end());
  for (std::size_t view = 0; view < views.size(); ++view) {
    result[view].observations.clear();
    for (std::size_t i = 0; i < views[view].observations.size(); ++i) {
      const auto draw = [&](Draw what) {
        return sample_hash(perturbation.seed, trial, view, i, int(what));
      };
      if (to_unit(draw(Draw::drop)) < perturbation.drop) continue;
      Observation seen = views[view].observations[i];
      if (to_unit(draw(Draw::misread)) < perturbation.wrong_ids) {
        seen.key = misread(seen.key, keys, draw(Draw::key));
      }
      if (auto* points = std::get_if<SeenPoints>(&seen.data); points && perturbation.noise_px > 0) {
        add_noise(*points, perturbation.noise_px, draw(Draw::noise));
      }
      result[view].observations.push_back(std::move(seen));
    }
  }
  return result;
}

}  // namespace vantage
