// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/digits.h"

#include <array>
#include <charconv>
#include <cmath>

namespace trismooth {

namespace {

/// std::to_chars with `how`. There is room for every double without an exponent, and for some 100 decimals.
template <typename T, typename... How>
std::string digits_of(T value, How... how) {
  std::array<char, 512> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, how...).ptr};
}

template <typename T>
std::string plain_text_of(T value) {
  constexpr int lowest_exponent = -4;
  constexpr int highest_exponent = 15;
  const std::string scientific = digits_of(value, std::chars_format::scientific);
  const std::size_t mark = scientific.find('e');
  if (!std::isfinite(value)) {
    return scientific;
  }
  const int exponent = std::stoi(scientific.substr(mark + 1));
  if (exponent < lowest_exponent || exponent > highest_exponent) {
    return scientific;
  }
  std::string digits = scientific.substr(0, mark);
  std::erase(digits, '.');
  const std::string sign = std::signbit(value) ? "-" : "";
  digits.erase(0, sign.size());
  if (exponent < 0) {
    return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  }
  const std::size_t before_point = static_cast<std::size_t>(exponent) + 1;
  return digits.size() <= before_point ? sign + digits + std::string(before_point - digits.size(), '0')
                                       : sign + digits.substr(0, before_point) + "." + digits.substr(before_point);
}

}  // namespace

std::string fixed_digits(double value, int decimals) {
  return digits_of(value, std::chars_format::fixed, decimals);
}

std::string scientific_digits(double value, int decimals) {
  return digits_of(value, std::chars_format::scientific, decimals);
}

std::string general_digits(double value, int digits) {
  return digits_of(value, std::chars_format::general, digits);
}

std::string shortest_digits(double value) {
  return digits_of(value, std::chars_format::fixed);
}

std::string shortest_text(double value) {
  return digits_of(value);
}

std::string plain_text(double value) {
  return plain_text_of(value);
}

std::string plain_text(float value) {
  return plain_text_of(value);
}

}  // namespace trismooth
