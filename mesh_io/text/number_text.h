// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/number_form.h"

namespace trismooth {

/// The number that `token` states as a whole (digits, optional sign, fraction, exponent), or nothing. Infinities and
/// NaN come back as such; a value below the range is 0 with its sign, one above it infinite. Locale-independent.
template <class T>
std::optional<T> parse_number(std::string_view token);

extern template std::optional<float> parse_number(std::string_view);
extern template std::optional<double> parse_number(std::string_view);

/// The whole number that `token` states as a whole, or nothing; also nothing beyond the range of 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// The whole number from 0 to 2^64 - 1 that `token` states as a whole, or nothing.
std::optional<std::uint64_t> parse_unsigned(std::string_view token);

/// The whole number that `token` states as a whole, of any type of integer of 8 to 64 bits: nothing beyond its range.
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

/// The number that `token` states as a whole, also with an exponent as Fortran writes it ("1.5D-3") or as Nastran does
/// ("1.5-3"); otherwise as parse_number().
template <class T>
std::optional<T> parse_fortran_number(std::string_view token);

extern template std::optional<float> parse_fortran_number(std::string_view);
extern template std::optional<double> parse_fortran_number(std::string_view);

/// Writes the text of the number that is nearest to the finite `value` among those that `most` characters hold to
/// `target`, which has room for 32. Returns how many characters it took: `most` at most where that is 8 or more (large
/// numbers and their neighbours in fewer characters do not exist).
template <class T>
std::size_t write_within(T value, std::size_t most, char* target);

extern template std::size_t write_within(float, std::size_t, char*);
extern template std::size_t write_within(double, std::size_t, char*);

/// write_within() in that form.
std::size_t write_within(double value, std::size_t most, NumberForm form, char* target);

/// The value that the text of write_within() reads back to; the value itself where `most` is 0.
double rounded_to_characters(double value, std::size_t most, NumberForm form = NumberForm::usual);

/// The finite `value` with 17 digits and an exponent of two or more behind `exponent` (D, E, ...), as Fortran writes it
/// by 1PD25.16: "1.5000000000000000D+00". It reads back to the same value; 24 characters at most.
std::string fortran_text(double value, char exponent);

/// Appends the shortest text that reads back to the same value.
void append_number(std::string& text, float value);
void append_number(std::string& text, double value);

}  // namespace trismooth
