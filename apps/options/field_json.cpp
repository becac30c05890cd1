#include "options/field_json.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // clang 14 does not find it by itself

Json vector_json(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Null where nothing is set, unless there is a word for it.
Json value_json(const Field& field) {
  const auto unset = [&] { return field.none.empty() ? Json() : Json(field.none); };
  return std::visit(
      Overloaded{
          [](const Choice& choice) { return choice.get().empty() ? Json() : Json(choice.get()); },
          [](const Eigen::Vector3d* v) { return vector_json(*v); },
          [&](const std::optional<Eigen::Vector3d>* v) { return *v ? vector_json(**v) : unset(); },
          [&]<class T>(const std::optional<T>* v) { return *v ? Json(**v) : unset(); },
          [](const auto* v) { return Json(*v); }},
      field.value);
}

double checked(const Value& value, double number, bool integer, const Field& field) {
  if (std::isfinite(number) && field.range.contains(number)) return number;
  throw value.error(fmt::format("found {:g}; expected {}", number, field.range.text(integer)));
}

template <class T>
T number_of(const Value& value, const Field& field) {
  constexpr bool integer = std::is_same_v<T, int>;
  return T(checked(value, value.as<double>(), integer, field));
}

template <class T>
std::vector<T> numbers_of(const Value& value, const Field& field) {
  if (!value.is_array()) return {number_of<T>(value, field)};
  std::vector<T> all;
  for (const Value& element : value.elements()) all.push_back(number_of<T>(element, field));
  return all;
}

void read_field(const Value& value, const Field& field) {
  std::visit(Overloaded{[&](const Choice& choice) { choice.set(value.as<std::string>()); },
                        [&](bool* v) { *v = value.as<bool>(); },
                        [&](std::optional<bool>* v) { *v = value.as<bool>(); },
                        [&](Eigen::Vector3d* v) { *v = value.vector(); },
                        [&](std::optional<Eigen::Vector3d>* v) { *v = value.vector(); },
                        [&]<class T>(std::vector<T>* v) { *v = numbers_of<T>(value, field); },
                        [&]<class T>(std::optional<T>* v) {
                          if (value.is_string()) return v->reset();  // the word for none
                          *v = number_of<T>(value, field);
                        },
                        [&]<class T>(T* v) { *v = number_of<T>(value, field); }},
             field.value);
}

Json number_schema(const char* type, const Field& field) {
  const auto bound = [&](double x) {
    return type == std::string("integer") ? Json(std::int64_t(x)) : Json(x);
  };
  Json schema{{"type", type}};
  if (std::isfinite(field.range.min)) {
    schema[field.range.without_min ? "exclusiveMinimum" : "minimum"] = bound(field.range.min);
  }
  if (std::isfinite(field.range.max)) schema["maximum"] = bound(field.range.max);
  if (!field.none.empty()) {
    schema["type"] = {type, "string"};
    schema["pattern"] = "^" + field.none + "$";
  }
  return schema;
}

/// A number, or a list of them.
Json list_schema(const char* type, const Field& field) {
  const Json number = number_schema(type, field);
  Json schema = number;
  schema["type"] = {type, "array"};
  schema["minItems"] = 1;
  schema["items"] = number;
  return schema;
}

Json vector_schema() {
  return {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", {{"type", "number"}}}};
}

Json type_schema(const Field& field) {
  return std::visit(
      Overloaded{[](const Choice& choice) {
                   return Json{{"enum", choice.names}};
                 },
                 [](const bool*) {
                   return Json{{"type", "boolean"}};
                 },
                 [](const std::optional<bool>*) {
                   return Json{{"type", "boolean"}};
                 },
                 [](const Eigen::Vector3d*) { return vector_schema(); },
                 [](const std::optional<Eigen::Vector3d>*) { return vector_schema(); },
                 [&](const std::vector<int>*) { return list_schema("integer", field); },
                 [&](const std::vector<double>*) { return list_schema("number", field); },
                 [&](const int*) { return number_schema("integer", field); },
                 [&](const std::optional<int>*) { return number_schema("integer", field); },
                 [&](const double*) { return number_schema("number", field); },
                 [&](const std::optional<double>*) { return number_schema("number", field); }},
      field.value);
}

Json field_schema(const Field& field) {
  Json schema{{"description", field.help}};
  schema.update(type_schema(field));
  const Json value = value_json(field);
  if (!value.is_null() && !(value.is_array() && value.empty())) schema["default"] = value;
  return schema;
}

void add_json(const FieldGroup& group, Json& to) {
  for (const Field& field : group.fields) to[field.key] = value_json(field);
  for (const FieldGroup& nested : group.nested) {
    add_json(nested, nested.key.empty() ? to : to[nested.key]);
  }
}

void add_schema(const FieldGroup& group, Json& properties) {
  for (const Field& field : group.fields) properties[field.key] = field_schema(field);
  for (const FieldGroup& nested : group.nested) {
    if (nested.key.empty()) {
      add_schema(nested, properties);
    } else {
      properties[nested.key] = schema_of(nested);
    }
  }
}

}  // namespace

Json to_json(const FieldGroup& group) {
  Json json = Json::object();
  add_json(group, json);
  return json;
}

void read_fields(const Value& value, const FieldGroup& group) {
  for (const Field& field : group.fields) {
    const char* key = field.key.c_str();
    if (value.has(key) && !value[key].is_null()) read_field(value[key], field);
  }
  for (const FieldGroup& nested : group.nested) {
    if (nested.key.empty()) {
      read_fields(value, nested);
    } else if (value.has(nested.key.c_str())) {
      read_fields(value[nested.key.c_str()], nested);
    }
  }
}

void read_given(const nlohmann::json& given, const FieldGroup& group) {
  const Document document{"the command line", given};
  read_fields(Value(document), group);
}

Json schema_of(const FieldGroup& group) {
  Json properties = Json::object();
  add_schema(group, properties);
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

}  // namespace vantage
