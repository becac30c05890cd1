#include "vantage/raycore/detail/instruction_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr const char* kVariable = "VANTAGE_MAX_ISA";
constexpr std::array<std::string_view, 4> kNames = {"sse4.2", "avx", "avx2", "avx512"};

/// What Embree asks for too, so that both always work at the same level.
InstructionSet of_machine() {
#if defined(__x86_64__)
  const bool avx = __builtin_cpu_supports("avx");
  const bool avx2 = avx && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (avx512) return InstructionSet::avx512;
  if (avx2) return InstructionSet::avx2;
  return avx ? InstructionSet::avx : InstructionSet::sse42;
#else
  return InstructionSet::sse42;
#endif
}

InstructionSet limit() {
  const char* value = std::getenv(kVariable);
  if (value == nullptr || *value == '\0') return InstructionSet::avx512;
  const auto* name = std::find(kNames.begin(), kNames.end(), value);
  if (name != kNames.end()) return InstructionSet(name - kNames.begin());
  throw bad_input(kVariable,
                  fmt::format("the environment variable is '{}'; expected {}, or an unset variable",
                              value, fmt::join(kNames, ", ")));
}

}  // namespace

InstructionSet instruction_set() {
  static const InstructionSet set = std::min(of_machine(), limit());
  return set;
}

std::string_view name_of(InstructionSet set) noexcept {
  return kNames[std::size_t(set)];
}

}  // namespace vantage
