// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/help_formatter.h"

#include <cstddef>
#include <utility>

#include "trismooth/pipeline/report/labelled_line.h"

namespace trismooth {

namespace {

constexpr std::size_t description_column = 27;

/// The name, and what is said of it: beside it, or below where it is too long for that.
std::string described(const std::string& name, const std::string& what) {
  std::string text = "  " + name;
  const std::string indent(description_column, ' ');
  if (text.size() + 2 > description_column) {
    return text + '\n' + wrapped(what, indent, indent);
  }
  text.resize(description_column, ' ');
  return wrapped(what, text, indent);
}

}  // namespace

HelpFormatter::HelpFormatter() {
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
  label("REQUIRED", "");
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), "", "");
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  return '\n' + Formatter::make_usage(app, std::move(name));
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = make_option_name(option, is_positional);
  if (const std::size_t comma = name.find(','); comma != std::string::npos) {
    name.insert(comma + 1, " ");
  }
  return described(name + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return described(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string help = Formatter::make_help(app, std::move(name), mode);
  for (std::size_t at = help.find("\n\n\n"); at != std::string::npos; at = help.find("\n\n\n", at)) {
    help.erase(at, 1);
  }
  help.erase(help.find_last_not_of('\n') + 1);
  return help + '\n';
}

}  // namespace trismooth
