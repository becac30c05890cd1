#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "evaluate/planning/planning_benchmark.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr const char* kExpected = "expected";
const std::vector<std::string> kSets{"full", "production"};

void refuse_twice(const std::string& where, const std::vector<std::string>& names) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) == name) continue;
    throw bad_input(where, fmt::format("found {} twice; name it once", *name));
  }
}

/// The power of the depth that a name ends in, if it is that method's name, D and a power.
template <class Kind>
std::optional<double> power_in(const std::string& name) {
  const std::string begin = std::string(Kind::kName) + "D";
  if (!name.starts_with(begin)) return std::nullopt;
  double power = 0;
  const char *const first = name.data() + begin.size(), *const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(first, last, power);
  const bool valid = error == std::errc() && end == last && power >= 0 && power <= 16;
  return valid ? std::optional(power) : std::nullopt;
}

/// A method under its name with its power.
template <class Kind>
NamedMethod by_depth(const Kind& method) {
  return {fmt::format("{}D{}", Kind::kName, method.depth_power), method};
}

}  // namespace

NamedMethod named_method(const std::string& name) {
  if (name == kExpected) return {name, VoxelMethod{}, ViewValue::expected};
  if (name == ShadowMethod::kName) return by_depth(ShadowMethod{});
  if (std::ranges::find(method_names(), name) != method_names().end()) {
    return {name, method_named(name)};
  }
  if (const auto power = power_in<ShadowMethod>(name)) {
    return by_depth(ShadowMethod{.depth_power = *power});
  }
  if (const auto power = power_in<MeshMethod>(name)) {
    return by_depth(MeshMethod{.weight = MeshWeight::depth, .depth_power = *power});
  }
  throw bad_input("--methods",
                  fmt::format("found '{}'; expected one of: expected, {}; or shadowD or meshD with "
                              "a depth power from 0 to 16, e.g. shadowD6",
                              name, fmt::join(method_names(), ", ")));
}

std::vector<NamedMethod> named_methods(const std::vector<std::string>& names) {
  std::vector<NamedMethod> methods;
  std::vector<std::string> full_names;
  for (const std::string& name : names) {
    methods.push_back(named_method(name));
    full_names.push_back(methods.back().name);
  }
  refuse_twice("--methods", full_names);
  return methods;
}

void choose(const std::vector<std::string>& methods, const std::vector<std::string>& sets,
            PlanningBenchmarkOptions& options) {
  refuse_twice("--candidates", sets);
  options.methods = {{std::string(VoxelMethod::kName), VoxelMethod{}}};
  for (NamedMethod& method : named_methods(methods)) {
    if (method.name == VoxelMethod::kName) continue;
    options.methods.push_back(std::move(method));
  }
  for (const std::string& set : kSets) {
    if (std::ranges::find(sets, set) != sets.end()) options.sets.push_back(set);
  }
}

}  // namespace vantage
