// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Of base64, a group of four characters states three bytes.
constexpr std::size_t base64_group_characters = 4;
constexpr std::size_t base64_group_bytes = 3;

inline constexpr std::string_view base64_alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
inline constexpr std::uint8_t not_base64 = 255;

inline constexpr std::array<std::uint8_t, 256> base64_value_of = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(not_base64);
  for (std::size_t i = 0; i < base64_alphabet.size(); ++i) {
    values[static_cast<unsigned char>(base64_alphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return values;
}();

/// The value of a character from 0 to 63; not_base64 where it has none, as '='.
inline std::uint8_t base64_value(char character) {
  return base64_value_of[static_cast<unsigned char>(character)];
}

/// Stores the three bytes that four values state.
inline void store_base64_group(std::byte* bytes, std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  bytes[0] = static_cast<std::byte>((a << 2) | (b >> 4));
  bytes[1] = static_cast<std::byte>(((b & 15) << 4) | (c >> 2));
  bytes[2] = static_cast<std::byte>(((c & 3) << 6) | d);
}

/// Decodes groups up to the first one that holds anything but the 64 characters of base64; how many those are.
std::size_t decode_base64_groups(const char* text, std::size_t groups, std::byte* bytes);

/// Appends `count` bytes as base64 to `text`, the last group filled up with '='.
void append_base64(const std::byte* bytes, std::size_t count, MemoryBlock& text);

}  // namespace trismooth
