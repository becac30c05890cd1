#include "vantage/raycore/detail/instruction_set.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "reference/random_scene.hpp"
#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage {
namespace {

constexpr InstructionSet kAll[] = {InstructionSet::sse42, InstructionSet::avx, InstructionSet::avx2,
                                   InstructionSet::avx512};

// All that would tempt a compiler to contract or to reorder: products in sums, a division, a root.
[[gnu::always_inline]] inline void mixed_body(const float* a, const float* b, std::size_t size,
                                              float* result) {
  for (std::size_t i = 0; i < size; ++i) {
    const float sum = a[i] * b[i] + a[i] * a[i] + b[i] * 0.3f;
    result[i] = __builtin_sqrtf(sum * sum + 1) / (b[i] * b[i] + 0.1f);
  }
}
constexpr Multiversion<mixed_body> mixed;

}  // namespace

TEST_CASE("the instruction set is within the limit that the environment sets") {
  const char* limit = std::getenv("VANTAGE_MAX_ISA");
  if (limit == nullptr) return;
  for (const InstructionSet set : kAll) {
    if (name_of(set) == limit) CHECK(instruction_set() <= set);
  }
}

TEST_CASE("kernels give the same bits with every instruction set") {
  test::Random random(5);
  const std::size_t size = 1003;  // not a multiple of any width
  std::vector<float> a(size), b(size), expected(size);
  for (std::size_t i = 0; i < size; ++i) {
    a[i] = float(random.uniform(-3, 3)), b[i] = float(random.uniform(-3, 3));
  }
  mixed(a.data(), b.data(), size, expected.data());
  for (const InstructionSet set : kAll) {
    if (set > instruction_set()) continue;
    CAPTURE(std::string(name_of(set)));
    std::vector<float> result(size);
    decltype(mixed)::of(set)(a.data(), b.data(), size, result.data());
    CHECK(std::memcmp(result.data(), expected.data(), size * sizeof(float)) == 0);
  }
}

}  // namespace vantage
