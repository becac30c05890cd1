#include "documents/yaml_scalar.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>

namespace vantage {
namespace {

using nlohmann::json;

/// Digits, a '+' in front allowed, as a number of this kind; nothing if it does not fit.
template <class Number, class... Base>
std::optional<json> number_of(std::string_view digits, Base... base) {
  Number value = 0;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, base...);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

bool is_one_of(std::string_view text, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// Cuts digits off the front. @returns how many.
std::size_t take_digits(std::string_view& text) {
  const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(count);
  return count;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// [-+]?[0-9]+
bool is_whole(std::string_view text) {
  take(text, "+-");
  return take_digits(text) > 0 && text.empty();
}

/// [-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?
bool is_real(std::string_view text) {
  take(text, "+-");
  const std::size_t before = take_digits(text);
  const std::size_t after = take(text, ".") ? take_digits(text) : 0;
  if (before + after == 0) return false;
  if (take(text, "eE")) {
    take(text, "+-");
    if (take_digits(text) == 0) return false;
  }
  return text.empty();
}

bool has_prefix_and_digits(std::string_view text, std::string_view prefix, const char* digits) {
  return text.starts_with(prefix) && text.size() > prefix.size() &&
         text.find_first_not_of(digits, prefix.size()) == std::string_view::npos;
}

/// ".inf" and its kin; nothing for anything else.
std::optional<double> not_finite(std::string_view text) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (is_one_of(text, {".nan", ".NaN", ".NAN", ".Nan"})) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (!is_one_of(text, {".inf", ".Inf", ".INF"})) return std::nullopt;
  return negative ? -kInfinity : kInfinity;
}

}  // namespace

// YAML 1.2.2, section 10.3.2.
std::optional<json> core_scalar(std::string_view text) {
  if (is_one_of(text, {"", "~", "null", "Null", "NULL"})) return json(nullptr);
  if (is_one_of(text, {"true", "True", "TRUE"})) return json(true);
  if (is_one_of(text, {"false", "False", "FALSE"})) return json(false);
  if (has_prefix_and_digits(text, "0o", "01234567")) {
    return number_of<std::int64_t>(text.substr(2), 8);
  }
  if (has_prefix_and_digits(text, "0x", "0123456789abcdefABCDEF")) {
    return number_of<std::int64_t>(text.substr(2), 16);
  }
  if (is_whole(text)) {
    const std::optional<json> value = number_of<std::int64_t>(text, 10);
    return value ? value : number_of<double>(text);
  }
  if (is_real(text)) return number_of<double>(text);
  if (const std::optional<double> value = not_finite(text)) return json(*value);
  return json(std::string(text));
}

}  // namespace vantage
