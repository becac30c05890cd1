#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>

#include "vantage/raycore/points.hpp"

namespace vantage::raycore::detail {

/// Bit l of the result is set if byte l, which is 0 or 1, is 1.
inline std::uint16_t to_bits(const std::uint8_t (&flags)[kPacketWidth]) {
  std::uint64_t halves[2];
  std::memcpy(halves, flags, sizeof(flags));
  // The factor's bits 56, 49 … 7 bring byte i's lowest bit to bit 56 + i; no two sums meet.
  constexpr std::uint64_t kGather = 0x0102040810204080;
  return std::uint16_t((halves[0] * kGather >> 56) | (halves[1] * kGather >> 56 << 8));
}

/// @throws Error bad_input if the sizes differ.
void check_batch_size(const char* what, std::size_t size, std::size_t expected);

/// @throws Error bad_input unless all arrays of a query for packets are of one size, and `points`
/// has every packet in full.
void check_packets(std::size_t points, std::span<const std::uint32_t> packets,
                   std::initializer_list<std::size_t> sizes);

}  // namespace vantage::raycore::detail
