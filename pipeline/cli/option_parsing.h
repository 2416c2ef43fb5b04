// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "trismooth/base/enum_text.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/suggestion.h"

namespace trismooth {

/// Adds an option whose text `parse` takes; a std::invalid_argument from there becomes a usage error that names the
/// option. `value_text` stands for the value in the help. May be given once, or where `repeatable` any number of times.
CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, const std::string& value_text,
                               const std::string& help, const std::function<void(const std::string&)>& parse,
                               bool repeatable = false);

/// The whole number that `text` states, from `lowest` to `highest`. Throws std::invalid_argument.
template <class Integer>
Integer parse_integer(std::string_view text, Integer lowest, Integer highest);

extern template int parse_integer(std::string_view, int, int);
extern template std::int64_t parse_integer(std::string_view, std::int64_t, std::int64_t);
extern template std::uint64_t parse_integer(std::string_view, std::uint64_t, std::uint64_t);

/// The count that `text` states, from `lowest` to `highest`: digits, with K for thousands or M for millions behind them
/// (either case): "1K", "50k", "2M". Throws std::invalid_argument.
std::int64_t parse_count(std::string_view text, std::int64_t lowest, std::int64_t highest);

/// The finite number that `text` states. Throws std::invalid_argument. Independent of the locale.
double parse_finite(std::string_view text);

/// A finite number that is not below `lowest`. Throws std::invalid_argument.
double parse_finite(std::string_view text, double lowest);

/// The parts of "a,b,c", each parsed.
template <class Parse>
auto parse_list(std::string_view text, const Parse& parse) {
  std::vector<decltype(parse(text))> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    values.push_back(parse(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return values;
}

/// The values of an enumeration as help shows them: "a|b".
template <class Enum>
std::string alternatives() {
  return list_text(
      EnumText<Enum>::texts, [](const auto& each) { return each.second; }, "|");
}

/// The value of a text, as parse_enum(); where there is none, the message ends with what may have been meant.
template <class Enum>
Enum parse_choice(std::string_view text) {
  std::vector<std::string> valid;
  for (const auto& [value, candidate] : EnumText<Enum>::texts) {
    valid.emplace_back(candidate);
  }
  try {
    return parse_enum<Enum>(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(error.what() + did_you_mean(text, valid));
  }
}

/// Adds an option that takes one text of an enumeration; its help ends with the default, the value at the call.
template <class Enum>
CLI::Option* add_enum_option(CLI::App& app, const std::string& name, Enum& value, const std::string& help) {
  return add_parsed_option(app, name, alternatives<Enum>(), help + " [" + std::string(to_string(value)) + "]",
                           [&value](const std::string& text) { value = parse_choice<Enum>(text); });
}

}  // namespace trismooth
