#include "core/packet_bits.hpp"

#include <fmt/format.h>

#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {

void check_batch_size(const char* what, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw bad_input("batch", fmt::format("{} has {} elements; expected {}", what, size, expected));
}

void check_packets(std::size_t points, std::span<const std::uint32_t> packets,
                   std::initializer_list<std::size_t> sizes) {
  for (const std::size_t size : sizes) check_batch_size("an array", size, packets.size());
  for (const std::uint32_t packet : packets) {
    if (packet < points / kPacketWidth) continue;
    throw bad_input("batch", fmt::format("packet {} of {} points; expected complete packets of {}",
                                         packet, points, kPacketWidth));
  }
}

}  // namespace vantage::raycore::detail
