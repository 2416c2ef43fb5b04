#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "trismooth/smoothing/enum_text.h"

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

/// The finite number that `text` states. Throws std::invalid_argument. Independent of the locale.
double parse_finite(std::string_view text);

/// The values of an enumeration as help shows them: "a|b".
template <class Enum>
std::string alternatives() {
  std::string list;
  for (const auto& [value, text] : EnumText<Enum>::texts) {
    list.append(list.empty() ? "" : "|").append(text);
  }
  return list;
}

/// Adds an option that takes one text of an enumeration; its help ends with the default, the value at the call.
template <class Enum>
CLI::Option* add_enum_option(CLI::App& app, const std::string& name, Enum& value, const std::string& help) {
  return add_parsed_option(app, name, alternatives<Enum>(), help + " [" + std::string(to_string(value)) + "]",
                           [&value](const std::string& text) { value = parse_enum<Enum>(text); });
}

}  // namespace trismooth
