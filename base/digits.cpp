#include "trismooth/base/digits.h"

#include <array>
#include <charconv>

namespace trismooth {

namespace {

/// std::to_chars with `how`. There is room for every double without an exponent, and for some 100 decimals.
template <typename... How>
std::string digits_of(double value, How... how) {
  std::array<char, 512> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, how...).ptr};
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

}  // namespace trismooth
