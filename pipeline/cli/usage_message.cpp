// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/usage_message.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/suggestion.h"

namespace trismooth {

namespace {

using Words = std::vector<std::string>;

bool is_option(const std::string& word) {
  return word.size() > 1 && word.front() == '-';
}

/// The name alone, without dashes and value.
std::string bare(const std::string& option) {
  const std::size_t begin = std::min(option.find_first_not_of('-'), option.size());
  return option.substr(begin, option.find('=', begin) - begin);
}

Words option_names(const CLI::App& command) {
  Words names;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

/// " (did you mean '--form'?)" or nothing.
std::string meant_option(const std::string& word, const CLI::App& command) {
  Words dashed = option_names(command);
  Words names;
  std::ranges::transform(dashed, std::back_inserter(names), &bare);
  std::string meant = did_you_mean(bare(word), names);
  if (const std::size_t quote = meant.find('\''); quote != std::string::npos) {
    meant.insert(quote + 1, "--");
  }
  return meant;
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
  Words names;
  for (const CLI::App* const command : app.get_subcommands(nullptr)) {
    names.push_back(command->get_name());
  }
  return "unknown command '" + word + "'" + did_you_mean(word, names);
}

/// Of the command that was chosen, or of the program where that is not known.
std::string unknown_option(const CLI::App& app, const std::string& word) {
  const auto chosen = app.get_subcommands();
  return "unknown option '" + word + "'" + meant_option(word, chosen.empty() ? app : *chosen.front());
}

std::string stray_arguments(const Words& words) {
  return (words.size() == 1 ? "unexpected argument " : "unexpected arguments ") +
         list_text(words, [](const std::string& word) { return "'" + word + "'"; });
}

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  constexpr bool of_commands_too = true;
  Words rest = app.remaining(of_commands_too);
  const auto mark = std::ranges::find(rest, "--");  // behind it no word is an option
  const auto option = std::find_if(rest.begin(), mark, &is_option);
  const int code = error.get_exit_code();
  if (app.get_subcommands().empty()) {
    return rest.empty()             ? "no command given"
           : option == rest.begin() ? unknown_option(app, *option)
                                    : unknown_command(app, rest.front());
  }
  const bool is_too_much = code == static_cast<int>(CLI::ExitCodes::ExtrasError);
  // A misspelt option is behind most of what is too much or missing: the parser takes its value for an argument.
  if (option != mark && (is_too_much || code == static_cast<int>(CLI::ExitCodes::RequiredError))) {
    return unknown_option(app, *option);
  }
  if (is_too_much) {
    if (mark != rest.end()) {
      rest.erase(mark);
    }
    return stray_arguments(rest);
  }
  const std::string message = error.what();
  if (code == static_cast<int>(CLI::ExitCodes::ArgumentMismatch)) {
    return message.substr(0, message.find(':')) + ": expected one value, and to be given once";
  }
  return message;
}

}  // namespace trismooth
