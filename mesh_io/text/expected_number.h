// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// "expected x (a finite number), got 'abc'".
inline std::string expected_text(std::string_view what, std::string_view kind, std::string_view word) {
  return "expected " + std::string(what) + " (" + std::string(kind) + "), got " + quoted(word);
}

/// The word as a whole number; `what` it is, and fail(message), which throws, is called where it is none.
template <class Fail>
std::int64_t whole_number(std::string_view word, std::string_view what, const Fail& fail) {
  const std::optional<std::int64_t> number = parse_integer(word);
  if (!number) {
    fail(expected_text(what, "a whole number", word));
  }
  return *number;
}

/// The same of a finite number, with an exponent as Fortran writes it or as others do.
template <class Fail>
double finite_number(std::string_view word, std::string_view what, const Fail& fail) {
  const std::optional<double> number = parse_fortran_number<double>(word);
  if (!number || !std::isfinite(*number)) {
    fail(expected_text(what, "a finite number", word));
  }
  return *number;
}

/// The same, or not-a-number, which stands for no value.
template <class Fail>
double finite_number_or_none(std::string_view word, std::string_view what, const Fail& fail) {
  const std::optional<double> number = parse_fortran_number<double>(word);
  if (!number || std::isinf(*number)) {
    fail(expected_text(what, "a finite number or nan", word));
  }
  return *number;
}

}  // namespace trismooth
