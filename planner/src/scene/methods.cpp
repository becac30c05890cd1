#include "vantage/planner/methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void check_power(double depth_power) {
  if (depth_power >= 0 && depth_power <= 16) return;  // false for NaN
  throw bad_input("method",
                  fmt::format("a depth power of {}; expected a number from 0 to 16", depth_power));
}

/// One of each, in the order of the variant.
const std::vector<Method>& all_methods() {
  static const auto methods = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<Method>{std::variant_alternative_t<I, Method>()...};
  }
  (std::make_index_sequence<std::variant_size_v<Method>>());
  return methods;
}

}  // namespace

void ShadowMethod::check() const {
  check_power(depth_power);
}

void MeshMethod::check() const {
  visibility.check();
  if (!std::isfinite(opening_m) || opening_m < 0) {
    throw bad_input(
        "mesh", fmt::format("an opening of {} m; expected a finite length, 0 or above", opening_m));
  }
  if (!(enlarge >= 1 && enlarge <= 10)) {  // also NaN
    throw bad_input("mesh",
                    fmt::format("known objects are scaled by {}; expected 1 to 10", enlarge));
  }
  check_power(depth_power);
  if (image_width < 16 || image_width > 16384) {
    throw bad_input("mesh", fmt::format("images of {} pixels; expected 16 to 16384", image_width));
  }
  if (exact_views < 0 || shortlist < 1 || !(shortlist_voxel_m > 0)) {
    throw bad_input("mesh", fmt::format("a shortlist of {} in voxels of {} m from {} views on; "
                                        "expected at least 1, a positive size and at least 0",
                                        shortlist, shortlist_voxel_m, exact_views));
  }
}

void check(const Method& method) {
  std::visit([](const auto& kind) { kind.check(); }, method);
}

std::string_view name_of(const Method& method) {
  return std::visit([](const auto& kind) { return kind.kName; }, method);
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Method& method : all_methods()) list.emplace_back(name_of(method));
    return list;
  }();
  return names;
}

Method method_named(std::string_view name) {
  for (const Method& method : all_methods()) {
    if (name_of(method) == name) return method;
  }
  throw bad_input("method", fmt::format("\"{}\" is unknown; expected one of {}", name,
                                        fmt::join(method_names(), ", ")));
}

}  // namespace vantage
