#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/sample_patterns.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::raycore::detail {

/// Rays from surfaces to the sky and the sun, gathered and traced together: no more than a Scene
/// traces without spreading them over tasks.
class LightBatch {
 public:
  static constexpr std::size_t kCapacity = 1024;

  struct Surface {
    Eigen::Vector3f from;  ///< a little above it
    Eigen::Vector3f normal;
    bool asks_sky, asks_sun;  ///< no ray is spent on what is not asked, and the answer is no
  };

  bool full() const { return count_ == kCapacity; }

  void add(const Surface& surface, const LightDirections& light, float sky_reach_m) {
    if (surface.asks_sky) {
      sky_.add(count_, surface.from,
               surface.from + sky_reach_m * turned(light.to_sky, surface.normal));
    }
    if (surface.asks_sun) {
      sun_.add(count_, surface.from, surface.from + kFarAway * light.to_sun);
    }
    ++count_;
  }

  /// Traces what was added, calls `use(i, sky, sun)` for each in order, and forgets it.
  template <class Use>
  void trace(const Scene& scene, const Use& use) {
    sky_.trace(scene);
    sun_.trace(scene);
    for (std::size_t i = 0; i < count_; ++i) use(i, sky_.reached[i] != 0, sun_.reached[i] != 0);
    sky_.clear(count_);
    sun_.clear(count_);
    count_ = 0;
  }

 private:
  static constexpr float kFarAway = 100;  // metres; nothing that matters is farther

  /// From the frame in which the normal is z into the world's, without a branch (Duff et al.,
  /// "Building an orthonormal basis, revisited", 2017).
  static Eigen::Vector3f turned(const Eigen::Vector3f& d, const Eigen::Vector3f& n) {
    const float sign = std::copysign(1.0f, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
    return {d.x() * (1 + sign * n.x() * n.x() * a) + d.y() * b + d.z() * n.x(),
            d.x() * sign * b + d.y() * (sign + n.y() * n.y() * a) + d.z() * n.y(),
            -d.x() * sign * n.x() - d.y() * n.y() + d.z() * n.z()};
  }

  struct Segments {
    std::size_t count = 0;
    Points from = Points(kCapacity), to = Points(kCapacity);
    std::uint32_t owner[kCapacity];
    std::uint8_t hidden[kCapacity];
    std::uint8_t reached[kCapacity] = {};  ///< by owner

    void add(std::size_t of, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
      from.set(count, a), to.set(count, b);
      owner[count++] = std::uint32_t(of);
    }
    void trace(const Scene& scene) {
      if (count == 0) return;
      scene.occluded(from.view().part(0, count), to.view().part(0, count), {hidden, count},
                     RayOrder::coherent);
      for (std::size_t i = 0; i < count; ++i) reached[owner[i]] = hidden[i] == 0;
    }
    void clear(std::size_t owners) {
      count = 0;
      std::fill_n(reached, owners, std::uint8_t(0));
    }
  };

  std::size_t count_ = 0;
  Segments sky_, sun_;
};

}  // namespace vantage::raycore::detail
