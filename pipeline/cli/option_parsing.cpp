// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/option_parsing.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, const std::string& value_text,
                               const std::string& help, const std::function<void(const std::string&)>& parse,
                               bool repeatable) {
  const auto parse_each = [name, parse](const CLI::results_t& texts) {
    for (const std::string& text : texts) {
      try {
        parse(text);
      } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError(name, error.what());
      }
    }
    return true;
  };
  CLI::Option* const option = app.add_option(name, parse_each, help)->option_text(value_text);
  // Each time the option is given it takes one value: the next word may be INPUT or OUTPUT.
  option->type_size(1)->expected(1)->allow_extra_args(false);
  if (repeatable) {
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  return option;
}

template <class Integer>
Integer parse_integer(std::string_view text, Integer lowest, Integer highest) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < lowest || value > highest) {
    throw std::invalid_argument(fmt::format("expected a whole number from {} to {}, got '{}'", lowest, highest, text));
  }
  return value;
}

template int parse_integer(std::string_view, int, int);
template std::int64_t parse_integer(std::string_view, std::int64_t, std::int64_t);
template std::uint64_t parse_integer(std::string_view, std::uint64_t, std::uint64_t);

std::int64_t parse_count(std::string_view text, std::int64_t lowest, std::int64_t highest) {
  const char last = text.empty() ? '\0' : text.back();
  const std::int64_t unit = last == 'K' || last == 'k' ? 1'000 : last == 'M' || last == 'm' ? 1'000'000 : 1;
  const std::string_view digits = unit > 1 ? text.substr(0, text.size() - 1) : text;
  try {
    return unit * parse_integer(digits, (lowest + unit - 1) / unit, highest / unit);
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument(
        fmt::format("expected a whole number from {} to {}, with K or M for thousands or millions, got '{}'", lowest,
                    highest, text));
  }
}

double parse_finite(std::string_view text) {
  const auto value = parse_number<double>(text);
  if (!value || !std::isfinite(*value)) {
    throw std::invalid_argument(fmt::format("expected a number, got '{}'", text));
  }
  return *value;
}

double parse_finite(std::string_view text, double lowest) {
  const double value = parse_finite(text);
  if (value < lowest) {
    throw std::invalid_argument(fmt::format("expected a number from {}, got '{}'", lowest, text));
  }
  return value;
}

}  // namespace trismooth
