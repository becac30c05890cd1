#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vantage {

/// The name of the group in which `heading`'s expert options are: --help leaves them out,
/// --help-all lists them below the others.
std::string expert_group(const std::string& heading);

/// Help that fits 100 columns: names and operands on the left, sentences on the right.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* verb) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  mutable bool all_ = false;  // set by make_help, which the rest is called from
};

/// The two flags, -h/--help and --help-all, and the layout; verbs that are added later inherit it.
void set_up_help(CLI::App& app);

}  // namespace vantage
