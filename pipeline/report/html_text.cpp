// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/html_text.h"

#include "trismooth/base/text/markup_entity.h"
#include "trismooth/base/text/printable_text.h"

namespace trismooth {

std::string escape_html(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const TextPiece piece = first_piece(text);
    const char first = piece.bytes.front();
    if (const std::string_view entity = markup_entity(first); !entity.empty()) {
      escaped += entity;
    } else if (first == '\'') {
      escaped += "&#39;";
    } else if (first == '\t' || first == '\n') {
      escaped += ' ';
    } else {
      escaped += piece.is_harmless ? piece.bytes : std::string_view("\xef\xbf\xbd");
    }
    text.remove_prefix(piece.bytes.size());
  }
  return escaped;
}

}  // namespace trismooth
