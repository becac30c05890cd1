#include "mesh/gltf/gltf_value.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {
namespace {

/// Short: what is printed may be anything.
std::string excerpt(const nlohmann::json& value) {
  if (value.is_structured()) return value.is_object() ? "an object" : "a list";
  return in_quotes(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

void GltfValue::fail(std::string message) const {
  throw bad_input(place_, std::move(message));
}

/// The root's place ends with a blank: "part.gltf: ".
std::string GltfValue::place_of(const char* key) const {
  return fmt::format("{}{}{}", place_, place_.ends_with(' ') ? "" : ".", key);
}

GltfValue GltfValue::member(const char* key) const {
  if (!has(key)) fail(fmt::format("\"{}\" is missing", key));
  return {value_->at(key), place_of(key)};
}

std::size_t GltfValue::element_count(const char* key) const {
  if (!has(key)) return 0;
  const nlohmann::json& list = value_->at(key);
  if (!list.is_array()) member(key).fail(fmt::format("is {}; expected a list", excerpt(list)));
  return list.size();
}

GltfValue GltfValue::element(const char* key, std::size_t index) const {
  const std::size_t count = element_count(key);
  const std::string name = place_of(key);
  if (index >= count) {
    throw bad_input(fmt::format("{}[{}]", name, index),
                    fmt::format("does not exist, but something refers to it; there are {}", count));
  }
  return {value_->at(key)[index], fmt::format("{}[{}]", name, index)};
}

std::uint64_t GltfValue::integer() const {
  constexpr double kLargest = 9007199254740992.0;  // 2^53
  const double value = value_->is_number() ? value_->get<double>() : -1;
  if (!(value >= 0 && value <= kLargest && value == std::floor(value))) {
    fail(fmt::format("is {}; expected an integer, 0 or more", excerpt(*value_)));
  }
  return std::uint64_t(value);
}

std::vector<double> GltfValue::numbers(const char* key, std::size_t count) const {
  const GltfValue list = member(key);
  const nlohmann::json& values = *list.value_;
  if (!values.is_array() || values.size() != count) {
    list.fail(fmt::format("is {}; expected a list of {} numbers", excerpt(values), count));
  }
  std::vector<double> result;
  for (const nlohmann::json& value : values) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      list.fail(fmt::format("has {} in it; expected {} numbers", excerpt(value), count));
    }
    result.push_back(value.get<double>());
  }
  return result;
}

const std::string& GltfValue::text() const {
  if (!value_->is_string()) fail(fmt::format("is {}; expected text", excerpt(*value_)));
  return value_->get_ref<const std::string&>();
}

bool GltfValue::truth(const char* key) const {
  return has(key) && value_->at(key).is_boolean() && value_->at(key).get<bool>();
}

}  // namespace vantage::raycore::detail
