#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace vantage::raycore::detail {

/// Makes triangles of a strip: each corner after the second one makes one with the two before it,
/// every other one turned over, so that all look to the same side.
class TriangleStrip {
 public:
  std::optional<std::array<std::int64_t, 3>> next(std::int64_t corner) {
    const std::array<std::int64_t, 3> triangle = {before_[0], before_[1], corner};
    before_ = {before_[1], corner};
    if (++count_ < 3) return std::nullopt;
    if (count_ % 2 == 1) return triangle;
    return std::array{triangle[1], triangle[0], triangle[2]};
  }

 private:
  std::array<std::int64_t, 2> before_ = {};
  std::uint64_t count_ = 0;
};

}  // namespace vantage::raycore::detail
