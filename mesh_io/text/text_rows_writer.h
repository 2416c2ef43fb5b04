#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/text/text_block.h"

namespace trismooth {

/// Writes a text file whose rows look as their format wants it. Lists of rows are formatted by all workers; the bytes
/// are the same for every number.
class TextRowsWriter {
 public:
  /// Throws WriteError.
  TextRowsWriter(const std::filesystem::path& path, const FileWorkers& workers)
      : writer_(path), blocks_([this](std::string_view block) { writer_.write(block); }, workers) {}
  TextRowsWriter(const TextRowsWriter&) = delete;
  TextRowsWriter& operator=(const TextRowsWriter&) = delete;

  /// Text as it is. Throws WriteError.
  void write_text(std::string_view text) { writer_.write(text); }

  /// Calls `format`(text, i) for i = 0 to `count` - 1, on any worker, which appends row i to `text`. Throws WriteError.
  template <class Format>
  void write_rows(std::size_t count, const Format& format) {
    constexpr std::size_t row_bytes = 64;
    blocks_.write_rows(count, row_bytes, [&format](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
      TextBlock text(bytes);
      for (std::size_t i = begin; i < end; ++i) {
        format(text, i);
      }
    });
  }

  /// Closes the file. Throws WriteError.
  void close() { writer_.close(); }

 private:
  BufferedWriter writer_;
  OrderedBlocks blocks_;
};

}  // namespace trismooth
