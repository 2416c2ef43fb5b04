// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/text/text_block.h"

namespace trismooth {

/// Lines of words and numbers, a blank between two of one line.
class TextLines {
 public:
  /// Appends to `bytes`, which must outlive it.
  explicit TextLines(MemoryBlock& bytes) : text_(bytes) {}

  TextLines& word(std::string_view text) {
    separate();
    text_.text(text);
    return *this;
  }
  /// A whole number, or the shortest text that reads back to the same value.
  template <class T>
  TextLines& number(T value) {
    separate();
    text_.number(value);
    return *this;
  }
  void end_line() {
    text_.text('\n');
    is_empty_ = true;
  }

 private:
  void separate() {
    if (!is_empty_) {
      text_.text(' ');
    }
    is_empty_ = false;
  }

  TextBlock text_;
  bool is_empty_ = true;  ///< the line, so far
};

/// Writes a text mesh file. Lists of rows and lines are formatted by all workers; the bytes are the same for every
/// number of them.
class TextMeshWriter {
 public:
  /// Throws WriteError.
  TextMeshWriter(const std::filesystem::path& path, const FileWorkers& workers)
      : writer_(path), blocks_([this](std::string_view block) { writer_.write(block); }, workers) {}
  TextMeshWriter(const TextMeshWriter&) = delete;
  TextMeshWriter& operator=(const TextMeshWriter&) = delete;

  /// Text as it is. Throws WriteError.
  void write_text(std::string_view text) { writer_.write(text); }

  /// Calls `format`(text, i) for i = 0 to `count` - 1, on any worker, which appends row i to `text` (TextBlock&) as the
  /// format wants it. Throws WriteError.
  template <class Format>
  void write_rows(std::size_t count, const Format& format) {
    write_blocks<TextBlock>(count, format);
  }

  /// Calls `format`(lines, i) for i = 0 to `count` - 1, on any worker, which appends whole lines, or none, to `lines`
  /// (TextLines&). Throws WriteError.
  template <class Format>
  void write_lines(std::size_t count, const Format& format) {
    write_blocks<TextLines>(count, format);
  }

  /// One line. Throws WriteError.
  template <class Format>
  void write_line(const Format& format) {
    write_lines(1, [&format](TextLines& lines, std::size_t /*i*/) {
      format(lines);
      lines.end_line();
    });
  }

  /// For what is written otherwise than in lines.
  OrderedBlocks& blocks() { return blocks_; }

  /// Closes the file. Throws WriteError.
  void close() { writer_.close(); }

 private:
  template <class Text, class Format>
  void write_blocks(std::size_t count, const Format& format) {
    constexpr std::size_t row_bytes = 64;
    blocks_.write_rows(count, row_bytes, [&format](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
      Text text(bytes);
      for (std::size_t i = begin; i < end; ++i) {
        format(text, i);
      }
    });
  }

  BufferedWriter writer_;
  OrderedBlocks blocks_;
};

}  // namespace trismooth
