// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>

namespace trismooth {

namespace {

/// from_chars says "out of range" for too large and too small alike; the decimal exponent of the first digit that is
/// not zero tells them apart.
bool is_tiny(std::string_view digits) {
  long exponent = 0;
  const std::size_t e = digits.find_first_of("eE");
  if (e != std::string_view::npos) {
    const std::size_t sign = digits[e + 1] == '+' ? 1 : 0;
    const char* const end = digits.data() + digits.size();
    if (std::from_chars(digits.data() + e + 1 + sign, end, exponent).ec == std::errc::result_out_of_range) {
      return digits[e + 1] == '-';
    }
  }
  const std::string_view mantissa = digits.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_of("123456789");
  const long place = first < point ? static_cast<long>(point - first) : -static_cast<long>(first - point - 1);
  // The sum may be beyond what holds the exponent.
  return exponent < -place;
}

template <class T>
void append_shortest(std::string& text, T value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

/// from_chars knows no plus sign.
const char* begin_of_number(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+';
  return token.data() + (plus ? 1 : 0);
}

/// A number in the form of Nastran from the text of its `scientific` form (-d.ddde-05), whichever of 0.00ddd and d.dd-3
/// is shorter.
std::string nastran_text(std::string_view scientific) {
  std::string text(scientific.starts_with('-') ? "-" : "");
  scientific.remove_prefix(text.size());
  const std::size_t e = scientific.find('e');
  const int exponent = *parse_integer_as<int>(scientific.substr(e + 1));
  std::string digits(scientific.substr(0, 1));
  digits.append(scientific.substr(std::min<std::size_t>(2, e), e - std::min<std::size_t>(2, e)));
  digits.erase(std::max<std::size_t>(digits.find_last_not_of('0') + 1, 1));
  const std::string power = (exponent < 0 ? "" : "+") + std::to_string(exponent);
  const auto magnitude = static_cast<std::size_t>(std::abs(exponent));
  const std::size_t plain_length =
      exponent < 0 ? magnitude + digits.size() : std::max(digits.size(), magnitude + 1) + 1;
  if (digits.size() + 1 + power.size() < plain_length) {
    return text + digits.substr(0, 1) + "." + digits.substr(1) + power;
  }
  if (exponent < 0) {
    return text + "." + std::string(magnitude - 1, '0') + digits;
  }
  digits.append(magnitude + 1 > digits.size() ? magnitude + 1 - digits.size() : 0, '0');
  return text + digits.insert(magnitude + 1, ".");
}

/// The text that `form` makes of the `scientific` form of a number, with as many of its digits as leave `most`
/// characters: for numbers that would be infinite if they were rounded to the nearest.
template <class Form>
std::string cut_text(std::string scientific, std::size_t most, const Form& form) {
  constexpr std::size_t shortest = std::string_view("-1.7").size();
  std::string text = form(scientific);
  for (std::size_t e = scientific.find('e'); text.size() > most && e > shortest; --e) {
    scientific.erase(e - 1, 1);
    text = form(scientific);
  }
  return text;
}

}  // namespace

template <class T>
std::optional<T> parse_number(std::string_view token) {
  const char* const begin = begin_of_number(token);
  const char* const end = token.data() + token.size();
  T value{};
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    const bool negative = *begin == '-';
    const T magnitude = is_tiny({begin + (negative ? 1 : 0), end}) ? T(0) : std::numeric_limits<T>::infinity();
    return negative ? -magnitude : magnitude;
  }
  return value;
}

template std::optional<float> parse_number(std::string_view);
template std::optional<double> parse_number(std::string_view);

template <class T>
std::optional<T> parse_integer_as(std::string_view token) {
  T value{};
  const char* const end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(begin_of_number(token), end, value);
  return stop == end && error == std::errc() ? std::optional(value) : std::nullopt;
}

template std::optional<std::int8_t> parse_integer_as(std::string_view);
template std::optional<std::uint8_t> parse_integer_as(std::string_view);
template std::optional<std::int16_t> parse_integer_as(std::string_view);
template std::optional<std::uint16_t> parse_integer_as(std::string_view);
template std::optional<std::int32_t> parse_integer_as(std::string_view);
template std::optional<std::uint32_t> parse_integer_as(std::string_view);
template std::optional<std::int64_t> parse_integer_as(std::string_view);
template std::optional<std::uint64_t> parse_integer_as(std::string_view);

template <class T>
std::optional<T> parse_fortran_number(std::string_view token) {
  const std::optional<T> plain = parse_number<T>(token);
  const std::size_t exponent = token.find_first_not_of("0123456789.", token.starts_with('-') || token.starts_with('+'));
  if (plain || exponent == std::string_view::npos || exponent == 0) {
    return plain;
  }
  constexpr std::string_view letters = "dDqQ";
  const bool is_letter = letters.find(token[exponent]) != std::string_view::npos;
  if (!is_letter && token[exponent] != '-' && token[exponent] != '+') {
    return std::nullopt;
  }
  std::string usual(token.substr(0, exponent));
  usual.append("e").append(token.substr(exponent + (is_letter ? 1 : 0)));
  return parse_number<T>(usual);
}

template std::optional<float> parse_fortran_number(std::string_view);
template std::optional<double> parse_fortran_number(std::string_view);

template <class T>
std::size_t write_within(T value, std::size_t most, char* target) {
  constexpr std::size_t room = 32;
  auto length = static_cast<std::size_t>(std::to_chars(target, target + room, value).ptr - target);
  for (int digits = std::numeric_limits<T>::max_digits10; length > most && digits > 0; --digits) {
    length = static_cast<std::size_t>(
        std::to_chars(target, target + room, value, std::chars_format::general, digits).ptr - target);
  }
  if (std::isfinite(value) && !std::isfinite(parse_number<T>({target, length}).value_or(value))) {
    length = static_cast<std::size_t>(std::to_chars(target, target + room, value, std::chars_format::scientific).ptr -
                                      target);
    const std::string text = cut_text({target, length}, most, [](const std::string& same) { return same; });
    return static_cast<std::size_t>(std::ranges::copy(text, target).out - target);
  }
  return length;
}

template std::size_t write_within(float, std::size_t, char*);
template std::size_t write_within(double, std::size_t, char*);

std::size_t write_within(double value, std::size_t most, NumberForm form, char* target) {
  if (form == NumberForm::usual) {
    return write_within(value, most, target);
  }
  std::array<char, 32> scientific{};
  char* const begin = scientific.data();
  char* const limit = begin + scientific.size();
  std::string text = nastran_text({begin, std::to_chars(begin, limit, value, std::chars_format::scientific).ptr});
  for (int digits = std::numeric_limits<double>::max_digits10; text.size() > most && digits > 0; --digits) {
    text = nastran_text({begin, std::to_chars(begin, limit, value, std::chars_format::scientific, digits - 1).ptr});
  }
  if (std::isfinite(value) && !std::isfinite(parse_fortran_number<double>(text).value_or(value))) {
    text =
        cut_text({begin, std::to_chars(begin, limit, value, std::chars_format::scientific).ptr}, most, &nastran_text);
  }
  std::ranges::copy(text, target);
  return text.size();
}

double rounded_to_characters(double value, std::size_t most, NumberForm form) {
  if (most == 0) {
    return value;
  }
  std::array<char, 32> text{};
  const std::size_t length = write_within(value, most, form, text.data());
  return parse_fortran_number<double>({text.data(), length}).value_or(value);
}

std::string fortran_text(double value, char exponent) {
  std::array<char, 32> buffer{};
  char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific,
                                  std::numeric_limits<double>::max_digits10 - 1)
                        .ptr;
  std::string text(buffer.data(), end);
  text[text.find('e')] = exponent;
  return text;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  return parse_integer_as<std::int64_t>(token);
}

std::optional<std::uint64_t> parse_unsigned(std::string_view token) {
  return parse_integer_as<std::uint64_t>(token);
}

void append_number(std::string& text, float value) {
  append_shortest(text, value);
}
void append_number(std::string& text, double value) {
  append_shortest(text, value);
}

}  // namespace trismooth
