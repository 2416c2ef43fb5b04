// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_writer.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/medit/medit_content.h"
#include "trismooth/mesh_io/medit/medit_reader.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

constexpr int usual_medit_version = 2;
constexpr int version_of_long_files = 3;
constexpr int version_of_long_integers = 4;

void write_medit_text(const std::filesystem::path& path, const MeditContent& content, const FileWorkers& workers) {
  const MeshDocument& document = content.document;
  TextMeshWriter writer(path, workers);
  const auto write_head = [&writer](std::string_view keyword, std::size_t count) {
    writer.write_line([&](TextLines& line) {
      line.word(keyword);
      line.end_line();
      line.number(count);
    });
  };
  writer.write_line([&](TextLines& line) {
    line.word("MeshVersionFormatted")
        .number(content.has_small_references() ? usual_medit_version : version_of_long_integers);
  });
  writer.write_line([&](TextLines& line) { line.word("Dimension").number(content.dimension); });
  write_head("Vertices", document.point_count());
  writer.write_lines(document.point_count(), [&](TextLines& lines, std::size_t vertex) {
    for (const double coordinate : std::span(document.points).subspan(3 * vertex, content.dimension)) {
      lines.number(coordinate);
    }
    lines.number(content.vertex_ref(vertex)).end_line();
  });
  for (const MeditContent::Section& section : content.sections) {
    write_head(section.keyword->name, section.cells.size());
    writer.write_lines(section.cells.size(), [&](TextLines& lines, std::size_t i) {
      for (const std::int32_t vertex : document.cells[section.cells[i]]) {
        lines.number(std::int64_t{vertex} + 1);
      }
      lines.number(content.cell_ref(section.cells[i])).end_line();
    });
  }
  for (const MeditContent::Set& set : content.sets) {
    write_head(set.keyword->name, set.numbers.size());
    writer.write_lines(set.numbers.size(),
                       [&set](TextLines& lines, std::size_t i) { lines.number(set.numbers[i]).end_line(); });
  }
  writer.write_line([](TextLines& line) { line.word("End"); });
  writer.close();
}

/// Writes the blocks of a binary file, in this machine's byte order, as libMeshb does.
class MeditBinaryWriter {
 public:
  MeditBinaryWriter(const std::filesystem::path& path, const MeditContent& content, const FileWorkers& workers)
      : content_(content),
        writer_(path),
        blocks_([this](std::string_view block) { writer_.write(block); }, workers),
        version_(!content.has_small_references() ? version_of_long_integers
                 : bytes_of_file(usual_medit_version) > std::numeric_limits<std::int32_t>::max()
                     ? version_of_long_files
                     : usual_medit_version) {}

  void write() {
    const MeshDocument& document = content_.document;
    write_bytes([this](MemoryBlock& bytes) {
      append<std::int32_t>(bytes, 1);
      append<std::int32_t>(bytes, version_);
    });
    begin_block(medit_code::dimension, sizeof(std::int32_t));
    write_bytes([this](MemoryBlock& bytes) { append<std::int32_t>(bytes, content_.dimension); });
    write_rows(medit_code::vertices, document.point_count(), vertex_bytes(version_),
               [&](MemoryBlock& bytes, std::size_t vertex) {
                 for (const double coordinate : std::span(document.points).subspan(3 * vertex, content_.dimension)) {
                   append<double>(bytes, coordinate);
                 }
                 append_integer(bytes, content_.vertex_ref(vertex));
               });
    for (const MeditContent::Section& section : content_.sections) {
      write_rows(section.keyword->code, section.cells.size(), cell_bytes(section, version_),
                 [&](MemoryBlock& bytes, std::size_t i) {
                   for (const std::int32_t vertex : document.cells[section.cells[i]]) {
                     append_integer(bytes, std::int64_t{vertex} + 1);
                   }
                   append_integer(bytes, content_.cell_ref(section.cells[i]));
                 });
    }
    for (const MeditContent::Set& set : content_.sets) {
      write_rows(set.keyword->code, set.numbers.size(), integer_bytes(version_),
                 [&](MemoryBlock& bytes, std::size_t i) { append_integer(bytes, set.numbers[i]); });
    }
    write_bytes([this](MemoryBlock& bytes) {
      append<std::int32_t>(bytes, medit_code::end);
      append_position(bytes, 0);
    });
    writer_.close();
  }

 private:
  static std::size_t integer_bytes(int version) {
    return version < version_of_long_integers ? sizeof(std::int32_t) : sizeof(std::int64_t);
  }
  static std::size_t position_bytes(int version) {
    return version < version_of_long_files ? sizeof(std::int32_t) : sizeof(std::int64_t);
  }
  std::size_t vertex_bytes(int version) const { return content_.dimension * sizeof(double) + integer_bytes(version); }
  static std::size_t cell_bytes(const MeditContent::Section& section, int version) {
    return (section.keyword->vertices + 1) * integer_bytes(version);
  }

  /// All but heads of blocks, which are few.
  std::size_t bytes_of_file(int version) const {
    constexpr std::size_t of_heads = 4096;
    std::size_t bytes = of_heads + content_.document.point_count() * vertex_bytes(version);
    for (const MeditContent::Section& section : content_.sections) {
      bytes += section.cells.size() * cell_bytes(section, version);
    }
    for (const MeditContent::Set& set : content_.sets) {
      bytes += set.numbers.size() * integer_bytes(version);
    }
    return bytes;
  }

  template <class T, class Value>
  static void append(MemoryBlock& bytes, Value value) {
    const T stored = static_cast<T>(value);
    std::memcpy(bytes.extend(sizeof(T)), &stored, sizeof(T));
  }
  void append_integer(MemoryBlock& bytes, std::int64_t value) const {
    version_ < version_of_long_integers ? append<std::int32_t>(bytes, value) : append<std::int64_t>(bytes, value);
  }
  void append_position(MemoryBlock& bytes, std::size_t position) const {
    version_ < version_of_long_files ? append<std::int32_t>(bytes, position) : append<std::int64_t>(bytes, position);
  }

  template <class Append>
  void write_bytes(const Append& append_to) {
    blocks_.write(1, [&append_to](std::size_t /*block*/, MemoryBlock& bytes) { append_to(bytes); });
  }

  /// A keyword with `size` bytes behind it and the position of the next one.
  void begin_block(std::int32_t code, std::size_t size) {
    position_ += sizeof(std::int32_t) + position_bytes(version_) + size;
    write_bytes([&](MemoryBlock& bytes) {
      append<std::int32_t>(bytes, code);
      append_position(bytes, position_);
    });
  }

  template <class AppendRow>
  void write_rows(std::int32_t code, std::size_t count, std::size_t row_bytes, const AppendRow& append_row) {
    begin_block(code, integer_bytes(version_) + count * row_bytes);
    write_bytes([&](MemoryBlock& bytes) { append_integer(bytes, static_cast<std::int64_t>(count)); });
    blocks_.write_rows(count, row_bytes, [&append_row](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
      for (std::size_t row = begin; row < end; ++row) {
        append_row(bytes, row);
      }
    });
  }

  const MeditContent& content_;
  BufferedWriter writer_;
  OrderedBlocks blocks_;
  int version_;
  std::size_t position_ = 2 * sizeof(std::int32_t);  ///< behind what is written
};

}  // namespace

namespace {

void write_medit_content(const std::filesystem::path& path, const MeditContent& content, const FileWorkers& workers) {
  if (names_binary_medit(path).value_or(false)) {
    MeditBinaryWriter(path, content, workers).write();
  } else {
    write_medit_text(path, content, workers);
  }
}

}  // namespace

void write_medit(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  write_medit_content(path, MeditContent(document), workers);
}

void write_medit_in_other_encoding(const std::filesystem::path& path, const MeshDocument& document,
                                   const FileWorkers& workers) {
  write_medit_content(path, MeditContent(document, MeditContent::Source::medit), workers);
}

}  // namespace trismooth
