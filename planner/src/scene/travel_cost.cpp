#include "vantage/planner/advanced/travel_cost.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage {

void TravelCost::check() const {
  if (from_m.allFinite() && std::isfinite(weight_per_m) && weight_per_m >= 0) return;
  throw bad_input("travel", fmt::format("weight {} per metre from [{}, {}, {}]; expected finite "
                                        "numbers, and a weight that is not negative",
                                        weight_per_m, from_m.x(), from_m.y(), from_m.z()));
}

}  // namespace vantage
