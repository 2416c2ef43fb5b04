#include "trismooth/mesh_io/text/text_mesh_writer.h"

#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

void TextMeshWriter::separate() {
  if (!line_.empty()) {
    line_ += ' ';
  }
}

TextMeshWriter& TextMeshWriter::word(std::string_view text) {
  separate();
  line_ += text;
  return *this;
}

TextMeshWriter& TextMeshWriter::number(double value) {
  separate();
  append_number(line_, value);
  return *this;
}

TextMeshWriter& TextMeshWriter::integer(std::int64_t value) {
  separate();
  append_integer(line_, value);
  return *this;
}

void TextMeshWriter::end_line() {
  line_ += '\n';
  writer_.write(line_);
  line_.clear();
}

void TextMeshWriter::close() {
  writer_.close();
}

}  // namespace trismooth
