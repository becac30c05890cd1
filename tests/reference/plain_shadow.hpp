#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vantage/raycore/advanced/scene.hpp"

namespace vantage::test {

/// What an image shows of the shadow (thesis 7.3), and how far that may be off.
struct PlainShadow {
  std::uint64_t pixels = 0, score = 0;            ///< the score in steps of 2^-35
  std::optional<std::array<int, 4>> bounds = {};  ///< left, right, top, bottom
  std::uint64_t close_calls = 0;                  ///< pixels that a hundredth of a pixel decides
  double tolerance = 0;                           ///< of the score
};

/// One ray after the other, for each pixel and four places around it. What those say otherwise is
/// the tolerance: Embree rounds a lone ray otherwise than a packet, by less than they are apart.
PlainShadow plain_shadow(const Scene& surfaces, ObjectId shadow, const PinholeCamera& view,
                         double power);

/// The same from packets, tile by tile: this the scorer has to match to the bit.
PlainShadow packet_shadow(const Scene& surfaces, ObjectId shadow, const PinholeCamera& view,
                          double power);

}  // namespace vantage::test
