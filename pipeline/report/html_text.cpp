#include "trismooth/pipeline/report/html_text.h"

#include "trismooth/pipeline/report/printable_text.h"

namespace trismooth {

std::string escape_html(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const TextPiece piece = first_piece(text);
    switch (piece.bytes.front()) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      case '\t':
      case '\n':
        escaped += ' ';
        break;
      default:
        escaped += piece.is_harmless ? piece.bytes : std::string_view("\xef\xbf\xbd");
    }
    text.remove_prefix(piece.bytes.size());
  }
  return escaped;
}

}  // namespace trismooth
