// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/base64.h"

#include <array>
#include <cstring>

namespace trismooth {

namespace {

/// The two characters of every twelve bits.
constexpr std::array<std::array<char, 2>, 4096> base64_pairs() {
  std::array<std::array<char, 2>, 4096> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i] = {base64_alphabet[i / 64], base64_alphabet[i % 64]};
  }
  return pairs;
}

constexpr std::array<std::array<char, 2>, 4096> base64_pair_of = base64_pairs();

void store_group(std::byte* target, std::byte a, std::byte b, std::byte c) {
  const unsigned bits =
      (std::to_integer<unsigned>(a) << 16) | (std::to_integer<unsigned>(b) << 8) | std::to_integer<unsigned>(c);
  std::memcpy(target, base64_pair_of[bits >> 12].data(), 2);
  std::memcpy(target + 2, base64_pair_of[bits & 4095].data(), 2);
}

}  // namespace

std::size_t decode_base64_groups(const char* text, std::size_t groups, std::byte* bytes) {
  for (std::size_t group = 0; group < groups; ++group, text += base64_group_characters, bytes += base64_group_bytes) {
    const std::uint8_t a = base64_value(text[0]);
    const std::uint8_t b = base64_value(text[1]);
    const std::uint8_t c = base64_value(text[2]);
    const std::uint8_t d = base64_value(text[3]);
    if ((a | b | c | d) > 63) {
      return group;
    }
    store_base64_group(bytes, a, b, c, d);
  }
  return groups;
}

void append_base64(const std::byte* bytes, std::size_t count, MemoryBlock& text) {
  const std::size_t groups = count / base64_group_bytes;
  const std::size_t rest = count % base64_group_bytes;
  std::byte* target = text.extend(base64_group_characters * (groups + (rest == 0 ? 0 : 1)));
  const std::byte* const end = bytes + base64_group_bytes * groups;
  for (; bytes != end; bytes += base64_group_bytes, target += base64_group_characters) {
    store_group(target, bytes[0], bytes[1], bytes[2]);
  }
  if (rest != 0) {
    store_group(target, bytes[0], rest == 2 ? bytes[1] : std::byte{0}, std::byte{0});
    std::memset(target + 1 + rest, '=', base64_group_bytes - rest);
  }
}

}  // namespace trismooth
