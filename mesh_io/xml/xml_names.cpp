// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xml/xml_names.h"

#include "trismooth/base/text/markup_entity.h"
#include "trismooth/base/text/utf8.h"

namespace trismooth {

namespace {

/// Whether XML may hold it: the last two of the first plane are no characters.
bool is_in_xml(const Utf8Character& character) {
  return character.length > 0 && character.code != 0xFFFE && character.code != 0xFFFF;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const Utf8Character character = first_utf8_character(text);
    if (!is_in_xml(character)) {
      return false;
    }
    text.remove_prefix(character.length);
  }
  return true;
}

}  // namespace

std::string as_xml_text(std::string_view text) {
  const bool utf8 = is_utf8(text);
  std::string characters;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 && character != '\t' && character != '\n' && character != '\r') {
      characters += '?';
    } else if (byte >= 0x80 && !utf8) {
      characters += static_cast<char>(0xC0 | (byte >> 6));
      characters += static_cast<char>(0x80 | (byte & 0x3F));
    } else {
      characters += character;
    }
  }
  return characters;
}

std::string escape_xml_attribute(std::string_view name) {
  std::string escaped;
  for (const char character : as_xml_text(name)) {
    switch (character) {
      case '\t':
        escaped += "&#9;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      case '\r':
        escaped += "&#13;";
        break;
      default: {
        const std::string_view entity = markup_entity(character);
        entity.empty() ? escaped += character : escaped += entity;
      }
    }
  }
  return escaped;
}

}  // namespace trismooth
