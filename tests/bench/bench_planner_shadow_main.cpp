#include <fmt/format.h>

#include <cstdio>

#include "bench_planner_shadow.hpp"

int main() {
  for (const auto& [what, result] : vantage::bench::shadow_report()) {
    std::fputs(fmt::format("{:<46} {}\n", what, result).c_str(), stdout);
  }
}
