#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace vantage {

// A field of an options struct, described once: the command line, the YAML and JSON readers, the
// schemas and the `config` that results echo are all made from this description.

/// Which numbers are valid.
struct ValidRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool without_min = false;  ///< the value has to be above `min`

  bool contains(double x) const { return (without_min ? x > min : x >= min) && x <= max; }
  /// E.g. "a number above 0", "an integer from 0 to 100".
  std::string text(bool integer) const;
};
inline ValidRange positive() {
  return {.min = 0, .without_min = true};
}
inline ValidRange not_negative() {
  return {.min = 0};
}
inline ValidRange from_to(double min, double max) {
  return {min, max};
}

/// An enumeration's value by name; people and files know only the names.
struct Choice {
  std::vector<std::string> names;
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;  ///< one of the names
};

/// Names of an enumeration's values.
template <class Enum>
using EnumNames = std::vector<std::pair<std::string, Enum>>;

/// A choice that reads and writes `value`, which has to outlive it.
template <class Enum>
Choice choice(Enum& value, const EnumNames<Enum>& names) {
  Choice all;
  for (const auto& [name, _] : names) all.names.push_back(name);
  all.get = [&value, names] {
    for (const auto& [name, named] : names) {
      if (named == value) return name;
    }
    return std::string();
  };
  all.set = [&value, names](const std::string& text) {
    for (const auto& [name, named] : names) {
      if (name == text) value = named;
    }
  };
  return all;
}

/// A list of names, which has to outlive the description.
struct NameList {
  std::vector<std::string> names;  ///< the valid ones; empty: any
  std::vector<std::string>* value = nullptr;
};

/// Where the value is; the struct has to outlive the description.
using FieldTarget = std::variant<bool*, int*, std::uint64_t*, double*, std::string*,
                                 std::optional<bool>*, std::optional<int>*, std::optional<double>*,
                                 Eigen::Vector3d*, std::optional<Eigen::Vector3d>*,
                                 std::vector<int>*, std::vector<double>*, Choice, NameList>;

/// Functions as one, for `std::visit` of a target.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // clang 14 does not find it by itself

/// Everything about one field.
struct Field {
  std::string key;            ///< in YAML and JSON; ends with the unit where that is not plain
  FieldTarget value;          ///< its default at first
  std::string help = {};      ///< a sentence without its full stop
  std::string option = {};    ///< on the command line, e.g. "--servo"; empty: not there
  std::string unit = {};      ///< e.g. "m", "px"; empty: none
  ValidRange range = {};      ///< of a number, or of each number of a list
  std::string none = {};      ///< a word for no value, where that is a choice of its own
  std::string fallback = {};  ///< what an unset value or an empty list means, for the help
  bool expert = false;        ///< listed by --help-all only
  bool flag = false;          ///< of a bool: its option stands alone and switches it on
};

/// The range of a `std::uint64_t`, whose lower bound is 0 where none is given.
inline ValidRange unsigned_range(const Field& field) {
  ValidRange range = field.range;
  range.min = std::max(range.min, 0.0);
  return range;
}

/// The fields of a struct, with those of the structs in it.
struct FieldGroup {
  std::string key;      ///< of the object that has the fields; empty: they stand in the parent's
  std::string heading;  ///< in the help
  std::vector<Field> fields;
  std::vector<FieldGroup> nested = {};
};

}  // namespace vantage
