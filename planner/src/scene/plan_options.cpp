#include "vantage/planner/plan_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage {

void ServoOptions::check() const {
  if (iterations < 0 || iterations > 100) {
    throw bad_input("servo", fmt::format("{} iterations; expected 0 to 100", iterations));
  }
  if (image_width < 16 || image_width > 16384) {
    throw bad_input("servo", fmt::format("images of {} pixels; expected 16 to 16384", image_width));
  }
}

void PolishOptions::check() const {
  if (views < 0 || views > 1000) {
    throw bad_input("polish", fmt::format("{} views; expected 0 to 1000", views));
  }
  if (image_width < 16 || image_width > 16384) {
    throw bad_input("polish",
                    fmt::format("images of {} pixels; expected 16 to 16384", image_width));
  }
}

void TravelCost::check() const {
  if (from_m.allFinite() && std::isfinite(weight_per_m) && weight_per_m >= 0) return;
  throw bad_input("travel", fmt::format("weight {} per metre from [{}, {}, {}]; expected finite "
                                        "numbers, and a weight that is not negative",
                                        weight_per_m, from_m.x(), from_m.y(), from_m.z()));
}

void SearchOptions::check() const {
  if (ranked < 1) {
    throw bad_input(
        "ranked",
        fmt::format("found {}; expected the number of exactly ranked top candidates, at least 1",
                    ranked));
  }
  if (travel) travel->check();
}

void ViewSequenceOptions::check() const {
  const bool gains =
      std::isfinite(min_gain_m3) && min_gain_m3 >= 0 && min_gain_share >= 0 && min_gain_share <= 1;
  if (most >= 1 && most <= 1000 && gains) return;
  throw bad_input("views",
                  fmt::format("{} views with a gain of at least {} m³ and {} of the shadow; "
                              "expected 1 to 1000 views, a volume that is not negative, and a "
                              "share from 0 to 1",
                              most, min_gain_m3, min_gain_share));
}

}  // namespace vantage
