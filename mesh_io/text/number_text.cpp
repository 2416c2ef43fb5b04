#include "trismooth/mesh_io/text/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
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
  return place + exponent < 0;
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
