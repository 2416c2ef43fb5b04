// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

using Kind = VtkLegacyType::Kind;

/// Of the names of one type, the first is the one that is written.
constexpr auto legacy_type_names = std::to_array<std::pair<std::string_view, VtkLegacyType>>({
    {"bit", {Kind::bits, ScalarType::uint8}},
    {"char", {Kind::numbers, ScalarType::int8}},
    {"signed_char", {Kind::numbers, ScalarType::int8}},
    {"unsigned_char", {Kind::numbers, ScalarType::uint8}},
    {"short", {Kind::numbers, ScalarType::int16}},
    {"unsigned_short", {Kind::numbers, ScalarType::uint16}},
    {"int", {Kind::numbers, ScalarType::int32}},
    {"unsigned_int", {Kind::numbers, ScalarType::uint32}},
    {"vtktypeint64", {Kind::numbers, ScalarType::int64}},
    {"vtktypeuint64", {Kind::numbers, ScalarType::uint64}},
    {"long", {Kind::numbers, ScalarType::int64}},
    {"unsigned_long", {Kind::numbers, ScalarType::uint64}},
    {"float", {Kind::numbers, ScalarType::float32}},
    {"double", {Kind::numbers, ScalarType::float64}},
    {"vtkidtype", {Kind::numbers, ScalarType::int32}},
    {"vtktypeint8", {Kind::numbers, ScalarType::int8}},
    {"vtktypeuint8", {Kind::numbers, ScalarType::uint8}},
    {"vtktypeint16", {Kind::numbers, ScalarType::int16}},
    {"vtktypeuint16", {Kind::numbers, ScalarType::uint16}},
    {"vtktypeint32", {Kind::numbers, ScalarType::int32}},
    {"vtktypeuint32", {Kind::numbers, ScalarType::uint32}},
    {"vtktypefloat32", {Kind::numbers, ScalarType::float32}},
    {"vtktypefloat64", {Kind::numbers, ScalarType::float64}},
    {"string", {Kind::strings, ScalarType::uint8}},
    {"utf8_string", {Kind::strings, ScalarType::uint8}},
    {"variant", {Kind::variants, ScalarType::uint8}},
});

void append_code(std::string& text, char c) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  text += '%';
  text += digits[byte / 16];
  text += digits[byte % 16];
}

bool needs_code(char c) {
  return c <= ' ' || c > '~' || c == '"' || c == '%';
}

/// VTK takes these for its own words where a field's array name may stand.
bool is_reserved(std::string_view name) {
  return name == "NULL_ARRAY" || lower_case(name.substr(0, 8)) == "metadata";
}

}  // namespace

std::optional<VtkLegacyType> vtk_legacy_type(std::string_view name) {
  const auto* const found =
      std::ranges::find(legacy_type_names, lower_case(name), &std::pair<std::string_view, VtkLegacyType>::first);
  return found == legacy_type_names.end() ? std::nullopt : std::optional(found->second);
}

std::string_view vtk_legacy_type_name(ScalarType type) {
  return std::ranges::find_if(
             legacy_type_names,
             [type](const auto& named) { return named.second.kind == Kind::numbers && named.second.scalar == type; })
      ->first;
}

std::string decode_vtk_name(std::string_view encoded) {
  std::string name;
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    unsigned char byte = 0;
    if (encoded[i] == '%' && i + 2 < encoded.size()) {
      const char* const end = encoded.data() + i + 3;
      if (std::from_chars(encoded.data() + i + 1, end, byte, 16).ptr == end) {
        name += static_cast<char>(byte);
        i += 2;
        continue;
      }
    }
    name += encoded[i];
  }
  return name;
}

std::string encode_vtk_name(std::string_view name) {
  std::string encoded;
  for (const char c : name) {
    if (needs_code(c) || (encoded.empty() && is_reserved(name))) {
      append_code(encoded, c);
    } else {
      encoded += c;
    }
  }
  return encoded;
}

}  // namespace trismooth
