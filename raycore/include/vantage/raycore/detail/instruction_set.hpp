#pragma once

#include <string_view>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// What a processor can do, as far as vantage and Embree make a difference. Each has all that those
/// before it have.
enum class InstructionSet {
  sse42,   ///< and older: what every x86-64 has
  avx,     ///< for Embree only; our own kernels are those of sse42
  avx2,    ///< 8 floats at once: most machines
  avx512,  ///< 16 floats at once: F, CD, DQ, BW and VL
};

/// The instruction set that Embree and our kernels use in this process: the best one that the
/// machine has, or less if the environment variable VANTAGE_MAX_ISA (sse4.2, avx, avx2 or avx512)
/// says so when this is first called. Thread-safe.
///
/// Our own kernels give the same bits with any of them. Embree's do not: its distances differ by
/// some 4e-7 of their size, and where two triangles touch either may be the one that is hit. So
/// results are the same on one machine, and alike on two.
/// @throws Error bad_input if VANTAGE_MAX_ISA is none of these.
VANTAGE_API InstructionSet instruction_set();

/// As VANTAGE_MAX_ISA and Embree spell it.
VANTAGE_API std::string_view name_of(InstructionSet set) noexcept;

}  // namespace vantage
