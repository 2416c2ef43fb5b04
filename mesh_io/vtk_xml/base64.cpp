#include "trismooth/mesh_io/vtk_xml/base64.h"

#include <array>
#include <cstring>
#include <string_view>

namespace trismooth {

namespace {

constexpr std::string_view base64_alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::uint8_t, 256> base64_values() {
  std::array<std::uint8_t, 256> values{};
  values.fill(not_base64);
  for (std::size_t i = 0; i < base64_alphabet.size(); ++i) {
    values[static_cast<unsigned char>(base64_alphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return values;
}

constexpr std::array<std::uint8_t, 256> base64_value_of = base64_values();

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

std::uint8_t base64_value(char character) {
  return base64_value_of[static_cast<unsigned char>(character)];
}

void store_base64_group(std::byte* bytes, std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  bytes[0] = static_cast<std::byte>((a << 2) | (b >> 4));
  bytes[1] = static_cast<std::byte>(((b & 15) << 4) | (c >> 2));
  bytes[2] = static_cast<std::byte>(((c & 3) << 6) | d);
}

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
