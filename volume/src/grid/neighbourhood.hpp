#pragma once

#include "grid/block_set.hpp"

namespace vantage::detail {

/// A block and the six around it.
class Neighbourhood {
 public:
  Neighbourhood(const BlockSet& set, std::size_t block)
      : set_(set), block_(set.layout().block_at(block)), here_(set.bits(block)) {}

  const BlockBits& here() const { return here_; }

  /// Bit for bit whether the neighbour along `axis`, in direction `step`, is in the set.
  BlockBits shifted(int axis, int step) const {
    const BlockBits beyond = at(block_ + step * Eigen::Vector3i::Unit(axis));
    BlockBits result;
    for (int x = 0; x < kBlockSide; ++x) {
      const std::size_t i = std::size_t(x);
      if (axis == 0) {
        const int from = x + step;
        const bool out = from < 0 || from >= kBlockSide;
        result.words[i] =
            out ? beyond.words[std::size_t(from & 7)] : here_.words[std::size_t(from)];
      } else {
        result.words[i] = axis == 1 ? rows(here_.words[i], beyond.words[i], step)
                                    : bits(here_.words[i], beyond.words[i], step);
      }
    }
    return result;
  }

 private:
  static std::uint64_t rows(std::uint64_t here, std::uint64_t beyond, int step) {
    return step > 0 ? (here >> 8) | (beyond << 56) : (here << 8) | (beyond >> 56);
  }
  static std::uint64_t bits(std::uint64_t here, std::uint64_t beyond, int step) {
    constexpr std::uint64_t kFirst = 0x0101010101010101;  // z = 0 of every row
    return step > 0 ? ((here >> 1) & ~(kFirst << 7)) | ((beyond & kFirst) << 7)
                    : ((here << 1) & ~kFirst) | ((beyond >> 7) & kFirst);
  }
  BlockBits at(const Eigen::Vector3i& block) const {
    const CellRange blocks = set_.layout().blocks();
    const bool inside = (block.array() >= 0).all() && (block.array() < blocks.last.array()).all();
    return inside ? set_.bits(set_.layout().index(block)) : BlockBits{};
  }

  const BlockSet& set_;
  Eigen::Vector3i block_;
  BlockBits here_;
};

}  // namespace vantage::detail
