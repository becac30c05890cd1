#include "options/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <concepts>
#include <memory>

#include "cli/help_formatter.hpp"

namespace vantage {
namespace {

/// The fields' object inside `given`, by the keys that lead to it.
nlohmann::json& object_at(nlohmann::json& given, const std::vector<std::string>& path) {
  nlohmann::json* object = &given;
  for (const std::string& key : path) object = &(*object)[key];
  return *object;
}

/// One option: what its text means, and what the help says of it.
class FieldOption {
 public:
  FieldOption(const Field& field, nlohmann::json& given, std::vector<std::string> path)
      : field_(field), given_(&given), path_(std::move(path)) {}

  void add_to(CLI::App& verb, const std::string& heading) const {
    const std::string group = field_.expert ? expert_group(heading) : heading;
    const FieldOption self = *this;
    if (field_.flag) {
      verb.add_flag_callback(
              field_.option, [self] { self.put(true); }, field_.help)
          ->group(group);
      return;
    }
    CLI::Option* option = verb.add_option(
        field_.option, [self](const CLI::results_t& texts) { return self.take(texts); }, help());
    option->group(group);
    option->option_text(operand());
    option->type_size(1);
    if (is_vector()) option->expected(3);
    if (is_list()) option->expected(1, CLI::detail::expected_max_vector_size);
    if (is_list()) option->delimiter(',');
    option->check(CLI::Validator([self](std::string& text) { return self.fault(text); }, ""));
  }

 private:
  template <class T>
  bool holds() const {
    return std::holds_alternative<T>(field_.value);
  }
  bool is_list() const {
    return holds<std::vector<int>*>() || holds<std::vector<double>*>() || holds<NameList>();
  }
  bool is_integer() const {
    return holds<int*>() || holds<std::optional<int>*>() || holds<std::vector<int>*>() ||
           is_unsigned();
  }
  bool is_unsigned() const { return holds<std::uint64_t*>(); }
  bool is_text() const { return holds<std::string*>() || holds<NameList>(); }
  bool is_switch() const { return holds<bool*>() || holds<std::optional<bool>*>(); }
  const Choice* as_choice() const { return std::get_if<Choice>(&field_.value); }
  bool is_vector() const {
    return holds<Eigen::Vector3d*>() || holds<std::optional<Eigen::Vector3d>*>();
  }

  std::vector<std::string> names() const {
    if (as_choice() != nullptr) return as_choice()->names;
    if (const auto* list = std::get_if<NameList>(&field_.value)) return list->names;
    return is_switch() ? std::vector<std::string>{"on", "off"} : std::vector<std::string>{};
  }

  std::string operand() const {
    if (!names().empty()) {
      return fmt::format("{}{}", fmt::join(names(), "|"), is_list() ? ",…" : "");
    }
    if (is_vector()) return "X Y Z";
    const std::string number = !field_.unit.empty() ? field_.unit
                               : is_text()          ? "TEXT"
                               : is_integer()       ? "N"
                                                    : "X";
    return is_list() ? number + ",…" : field_.none.empty() ? number : number + "|" + field_.none;
  }

  std::string shown_default() const {
    if (!field_.fallback.empty()) return field_.fallback;
    return std::visit(
        Overloaded{
            [](const Choice& choice) { return choice.get(); },
            [](const NameList& list) { return fmt::format("{}", fmt::join(*list.value, ",")); },
            [](const std::string* v) { return *v; },
            [](const bool* v) { return std::string(*v ? "on" : "off"); },
            [](const double* v) { return fmt::format("{:g}", *v); },
            [&](const std::optional<double>* v) {
              return *v ? fmt::format("{:g}", **v) : field_.none;
            },
            []<std::integral T>(const T* v) { return fmt::format("{}", *v); },
            [](const std::vector<double>* v) { return fmt::format("{:g}", fmt::join(*v, ",")); },
            [](const std::vector<int>* v) { return fmt::format("{}", fmt::join(*v, ",")); },
            [](const auto*) { return std::string(); }},
        field_.value);
  }

  std::string help() const {
    const std::string value = shown_default();
    return value.empty() ? field_.help : fmt::format("{} (default: {})", field_.help, value);
  }

  /// What is wrong with the text; empty: nothing.
  std::string fault(const std::string& text) const {
    if (const auto all = names(); !all.empty()) {
      if (std::ranges::find(all, text) != all.end()) return {};
      return fmt::format("found '{}'; expected one of {}", text, fmt::join(all, ", "));
    }
    if (is_text() || (!field_.none.empty() && text == field_.none)) return {};
    if (is_unsigned()) {
      const auto number = unsigned_of(text);
      if (number && field_.range.contains(double(*number))) return {};
      return fmt::format("found '{}'; expected {}", text, unsigned_range(field_).text(true));
    }
    if (const auto number = parsed(text); number && field_.range.contains(*number)) return {};
    return fmt::format("found '{}'; expected {}{}", text, field_.range.text(is_integer()),
                       field_.none.empty() ? "" : ", or " + field_.none);
  }

  /// All 64 bits, which a double does not hold.
  static std::optional<std::uint64_t> unsigned_of(const std::string& text) {
    std::uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
  }

  std::optional<double> parsed(const std::string& text) const {
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    if (is_integer()) {
      int number = 0;
      const auto [stop, error] = std::from_chars(begin, end, number);
      return error == std::errc() && stop == end ? std::optional<double>(number) : std::nullopt;
    }
    double number = 0;
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
    return number;
  }

  nlohmann::json json_of(const std::string& text) const {
    if (is_switch()) return text == "on";
    if (is_text()) return text;
    if (is_unsigned()) return unsigned_of(text).value();
    if (as_choice() != nullptr || (!field_.none.empty() && text == field_.none)) return text;
    const double number = parsed(text).value();
    return is_integer() ? nlohmann::json(int(number)) : nlohmann::json(number);
  }

  bool take(const CLI::results_t& texts) const {
    nlohmann::json value = nlohmann::json::array();
    for (const std::string& text : texts) value.push_back(json_of(text));
    put(is_list() || is_vector() ? value : value.at(0));
    return true;
  }

  void put(const nlohmann::json& value) const { object_at(*given_, path_)[field_.key] = value; }

  Field field_;
  nlohmann::json* given_;
  std::vector<std::string> path_;
};

void add_group(CLI::App& verb, const FieldGroup& group, const std::string& heading,
               nlohmann::json& given, const std::vector<std::string>& path) {
  for (const Field& field : group.fields) {
    if (!field.option.empty()) FieldOption(field, given, path).add_to(verb, heading);
  }
  for (const FieldGroup& nested : group.nested) {
    std::vector<std::string> inner = path;
    if (!nested.key.empty()) inner.push_back(nested.key);
    add_group(verb, nested, nested.heading.empty() ? heading : nested.heading, given, inner);
  }
}

}  // namespace

void add_fields(CLI::App& verb, const FieldGroup& group, nlohmann::json& given) {
  add_group(verb, group, group.heading, given, {});
}

}  // namespace vantage
