#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {

/// A value of a glTF's JSON that knows where it stands, so that what is wrong with it can be said:
/// "part.gltf: accessors[3].count". Does not own it.
class GltfValue {
 public:
  GltfValue(const nlohmann::json& value, std::string place)
      : value_(&value), place_(std::move(place)) {}

  const std::string& place() const { return place_; }
  bool has(const char* key) const { return value_->is_object() && value_->contains(key); }

  // All throw Error bad_input with the place.

  /// @throws if it is missing.
  GltfValue member(const char* key) const;

  /// The elements of a list; none if it is missing.
  std::size_t element_count(const char* key) const;
  GltfValue element(const char* key, std::size_t index) const;

  /// An integer, 0 or more.
  std::uint64_t integer() const;
  std::uint64_t integer(const char* key) const { return member(key).integer(); }
  std::uint64_t integer(const char* key, std::uint64_t missing) const {
    return has(key) ? integer(key) : missing;
  }

  /// A list of so many finite numbers.
  std::vector<double> numbers(const char* key, std::size_t count) const;

  const std::string& text() const;
  bool truth(const char* key) const;  ///< false if it is missing

  [[noreturn]] void fail(std::string message) const;

 private:
  std::string place_of(const char* key) const;

  const nlohmann::json* value_;
  std::string place_;
};

}  // namespace vantage::raycore::detail
