#include "cli/help_formatter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace vantage {
namespace {

constexpr std::string_view kExpert = ", expert options";
constexpr std::size_t kIndent = 2, kColumn = 30, kWidth = 100;

bool is_expert(const std::string& group) {
  return group.ends_with(kExpert);
}

/// Columns that a UTF-8 text takes.
std::size_t columns(std::string_view text) {
  return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Breaks a text into lines of at most `width` columns.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (columns(line) + 1 + columns(word) <= width) {
      line += ' ' + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

/// One entry: the left part, and beside or below it the right one.
std::string entry(const std::string& left, const std::string& right) {
  std::string out(kIndent, ' ');
  out += left;
  std::size_t at = kIndent + columns(left);
  for (const std::string& line : wrapped(right, kWidth - kColumn)) {
    if (at + 2 > kColumn) {
      out += '\n';
      at = 0;
    }
    out += std::string(kColumn - at, ' ') + line;
    at = kWidth;
  }
  return out + '\n';
}

/// "a|b" of CLI11's "TEXT:{a,b}"; the bare type of everything else.
std::string operand_of(const CLI::Option& option) {
  if (!option.get_option_text().empty()) return option.get_option_text();
  if (option.get_type_size() == 0) return {};
  const std::string type = option.get_type_name();
  const std::size_t open = type.find(":{"), close = type.find('}');
  if (open != std::string::npos && close != std::string::npos) {
    std::string names = type.substr(open + 2, close - open - 2);
    std::ranges::replace(names, ',', '|');
    return names;
  }
  std::string bare = type.substr(0, type.find(':'));
  if (bare == "INT" || bare == "UINT") bare = "N";
  if (bare == "FLOAT") bare = "X";
  if (option.get_expected_min() > 1) return fmt::format("{} x {}", bare, option.get_expected_min());
  return option.get_expected_max() > 1 ? bare + ",…" : bare;
}

}  // namespace

std::string expert_group(const std::string& heading) {
  return heading + std::string(kExpert);
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  all_ = mode == CLI::AppFormatMode::All;
  std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  // CLI11 leaves a blank line or two for a group that is left out.
  for (std::size_t at; (at = help.find("\n\n\n")) != std::string::npos;) help.erase(at, 1);
  return help;
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  if (is_expert(group) && !all_) return {};
  return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string left = is_positional ? option->get_name(true, false) : option->get_name(false, true);
  std::ranges::replace(left, ',', ' ');
  const std::string operand = operand_of(*option);
  if (!operand.empty() && !is_positional) left += ' ' + operand;
  std::string right = option->get_description();
  if (!option->get_default_str().empty()) {
    right += fmt::format(" (default: {})", option->get_default_str());
  }
  return entry(left, right);
}

std::string HelpFormatter::make_subcommand(const CLI::App* verb) const {
  return entry(verb->get_name(), verb->get_description());
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  const bool hides = !all_ && std::ranges::any_of(app->get_groups(), is_expert);
  std::string footer = app->get_footer();
  if (hides)
    footer +=
        (footer.empty() ? "" : "\n\n") + std::string("`--help-all` also lists the expert options.");
  return footer.empty() ? footer : footer + '\n';
}

void set_up_help(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this help");
  app.set_help_all_flag("--help-all", "Print this help and the expert options");
}

}  // namespace vantage
