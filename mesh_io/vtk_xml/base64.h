#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Of base64, a group of four characters states three bytes.
constexpr std::size_t base64_group_characters = 4;
constexpr std::size_t base64_group_bytes = 3;

/// The value of a character from 0 to 63; not_base64 where it has none, as '='.
std::uint8_t base64_value(char character);
constexpr std::uint8_t not_base64 = 255;

/// Stores the three bytes that four values state.
void store_base64_group(std::byte* bytes, std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d);

/// Decodes groups up to the first one that holds anything but the 64 characters of base64; how many those are.
std::size_t decode_base64_groups(const char* text, std::size_t groups, std::byte* bytes);

/// Appends `count` bytes as base64 to `text`, the last group filled up with '='.
void append_base64(const std::byte* bytes, std::size_t count, MemoryBlock& text);

}  // namespace trismooth
