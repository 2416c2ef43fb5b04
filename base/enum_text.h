// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace trismooth {

/// The text forms of an enumeration, in one place. It is specialised beside each enumeration with a member `what` (the
/// noun in messages) and a member `texts` (pairs of value and text). It may have a member `meanings`: what each of them
/// stands for, for help.
template <class Enum>
struct EnumText;

/// The text of a value, as options, messages and reports write it.
template <class Enum>
requires requires {
  EnumText<Enum>::texts;
}
[[nodiscard]] constexpr std::string_view to_string(Enum value) {
  for (const auto& [candidate, text] : EnumText<Enum>::texts) {
    if (candidate == value) {
      return text;
    }
  }
  return "?";
}

/// Every value of the enumeration.
template <class Enum>
[[nodiscard]] constexpr auto values_of() {
  std::array<Enum, EnumText<Enum>::texts.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = EnumText<Enum>::texts[i].first;
  }
  return values;
}

/// Every text of the enumeration: "a, b".
template <class Enum>
[[nodiscard]] std::string valid_texts() {
  std::string list;
  for (const auto& [value, text] : EnumText<Enum>::texts) {
    list.append(list.empty() ? "" : ", ").append(text);
  }
  return list;
}

/// Every text of the enumeration with its meaning: "a: before the sweep; b: in the sweep".
template <class Enum>
[[nodiscard]] std::string explained_texts() {
  std::string list;
  for (std::size_t i = 0; i < EnumText<Enum>::texts.size(); ++i) {
    list.append(list.empty() ? "" : "; ").append(EnumText<Enum>::texts[i].second);
    list.append(": ").append(EnumText<Enum>::meanings[i]);
  }
  return list;
}

/// The value of a text. Throws std::invalid_argument: "unknown form 'c'; valid are a, b".
template <class Enum>
[[nodiscard]] Enum parse_enum(std::string_view text) {
  for (const auto& [value, candidate] : EnumText<Enum>::texts) {
    if (candidate == text) {
      return value;
    }
  }
  throw std::invalid_argument("unknown " + std::string(EnumText<Enum>::what) + " '" + std::string(text) +
                              "'; valid are " + valid_texts<Enum>());
}

}  // namespace trismooth
