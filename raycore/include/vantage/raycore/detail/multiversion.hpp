#pragma once

#include "vantage/raycore/detail/instruction_set.hpp"

namespace vantage {

/// A hot kernel of ours, compiled for several instruction sets; a call goes to the version for
/// `instruction_set()`. With -ffp-contract=off all of them give the same bits.
///
///     [[gnu::always_inline]] inline void add_body(const float* a, float* b) { … }
///     constexpr Multiversion<add_body> add;
///
/// The body must be always_inline: that is how each version gets its own code of it. It is chosen
/// at the first call and not, as by GCC's target_clones, when the program is loaded: that is too
/// early for the environment and for the sanitizers.
template <auto kBody>
struct Multiversion;

template <class Result, class... Arguments, Result (*kBody)(Arguments...)>
struct Multiversion<kBody> {
  using Function = Result (*)(Arguments...);

  Result operator()(Arguments... arguments) const { return version()(arguments...); }

  /// For choosing between kernels of one type.
  operator Function() const { return version(); }

  /// The version for one instruction set, which the machine must have.
  static Function of([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
    if (set >= InstructionSet::avx512) return avx512;
    if (set >= InstructionSet::avx2) return avx2;
#endif
    return base;
  }

 private:
  static Result base(Arguments... arguments) {
    return kBody(arguments...);
  }
#if defined(__x86_64__)
  [[gnu::target("avx2")]] static Result avx2(Arguments... arguments) {
    return kBody(arguments...);
  }
  [[gnu::target("avx512f")]] static Result avx512(Arguments... arguments) {
    return kBody(arguments...);
  }
#endif

  static Function version() {
    static const Function chosen = of(instruction_set());
    return chosen;
  }
};

}  // namespace vantage
