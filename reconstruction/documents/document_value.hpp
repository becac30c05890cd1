#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "documents/document.hpp"

namespace vantage {

/// A value of a document that passed its schema: types and lengths need no second look. The
/// document has to outlive it.
class Value {
 public:
  explicit Value(const Document& document) : Value(document, document.root, "") {}

  bool has(const char* key) const { return json_->contains(key); }
  bool is_null() const { return json_->is_null(); }
  bool is_string() const { return json_->is_string(); }
  bool is_array() const { return json_->is_array(); }
  Value operator[](const char* key) const {
    return {*document_, json_->at(key), child(pointer_, key)};
  }
  std::vector<Value> elements() const {
    std::vector<Value> all;
    for (std::size_t i = 0; i < json_->size(); ++i) {
      all.push_back({*document_, (*json_)[i], child(pointer_, i)});
    }
    return all;
  }

  /// The keys of a mapping, in alphabetical order, with their values.
  std::vector<std::pair<std::string, Value>> members() const {
    std::vector<std::pair<std::string, Value>> all;
    for (const auto& [key, value] : json_->items()) all.push_back({key, (*this)[key.c_str()]});
    return all;
  }

  template <class T>
  T as() const {
    return json_->get<T>();
  }
  /// The value of a key, or `otherwise` where there is none.
  template <class T>
  T get(const char* key, T otherwise) const {
    return has(key) ? (*this)[key].as<T>() : otherwise;
  }
  Eigen::Vector3d vector() const { return {number(0), number(1), number(2)}; }
  double number(std::size_t index) const { return (*json_)[index].get<double>(); }

  std::string place() const { return document_->place(pointer_); }
  Error error(std::string message) const { return bad_input(place(), std::move(message)); }

 private:
  Value(const Document& document, const nlohmann::json& json_value, std::string pointer)
      : document_(&document), json_(&json_value), pointer_(std::move(pointer)) {}

  const Document* document_;
  const nlohmann::json* json_;
  std::string pointer_;
};

}  // namespace vantage
