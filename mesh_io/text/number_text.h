#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trismooth {

/// The number that `token` states as a whole (digits, optional sign, fraction, exponent), or nothing. Infinities and
/// NaN come back as such; a value below the range is 0 with its sign, one above it infinite. Locale-independent.
template <class T>
std::optional<T> parse_number(std::string_view token);

extern template std::optional<float> parse_number(std::string_view);
extern template std::optional<double> parse_number(std::string_view);

/// The whole number that `token` states as a whole, or nothing; also nothing beyond the range of 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// The same from 0 to 2^64 - 1.
std::optional<std::uint64_t> parse_unsigned(std::string_view token);

/// The same for any type of integer of 8 to 64 bits: nothing beyond its range.
template <class T>
std::optional<T> parse_integer_as(std::string_view token);

extern template std::optional<std::int8_t> parse_integer_as(std::string_view);
extern template std::optional<std::uint8_t> parse_integer_as(std::string_view);
extern template std::optional<std::int16_t> parse_integer_as(std::string_view);
extern template std::optional<std::uint16_t> parse_integer_as(std::string_view);
extern template std::optional<std::int32_t> parse_integer_as(std::string_view);
extern template std::optional<std::uint32_t> parse_integer_as(std::string_view);
extern template std::optional<std::int64_t> parse_integer_as(std::string_view);
extern template std::optional<std::uint64_t> parse_integer_as(std::string_view);

/// Appends the shortest text that reads back to the same value.
void append_number(std::string& text, float value);
void append_number(std::string& text, double value);

}  // namespace trismooth
