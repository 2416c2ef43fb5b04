// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/text/text_block.h"

namespace trismooth {

/// Numbers of a legacy VTK file, ASCII or BINARY (big-endian), at the end of a block of bytes.
class VtkLegacyNumbers {
 public:
  /// `bytes` must outlive it.
  VtkLegacyNumbers(bool binary, MemoryBlock& bytes) : binary_(binary), bytes_(bytes) {}

  /// One number: in ASCII the shortest text that reads back to the same value, and `separator` behind it.
  template <class T>
  void append(T value, char separator) {
    if (!binary_) {
      TextBlock(bytes_).number(value).text(separator);
      return;
    }
    const T stored = in_byte_order<std::endian::big>(value);
    bytes_.append(&stored, sizeof(T));
  }

 private:
  bool binary_;
  MemoryBlock& bytes_;
};

/// Builds the parts of a legacy VTK file, ASCII or BINARY, by all workers and hands them on from front to back.
class VtkLegacyOutput {
 public:
  /// `workers` and what the sink refers to must outlive it.
  VtkLegacyOutput(bool binary, ByteSink sink, const FileWorkers& workers)
      : binary_(binary), blocks_(std::move(sink), workers) {}

  /// Text as it is, in both encodings.
  void text(std::string_view text) { blocks_.write(text); }
  /// A list of numbers, in rows 0 to `count` - 1 of about `row_bytes`: `append`(numbers, row) appends one.
  template <class Append>
  void numbers(std::size_t count, std::size_t row_bytes, const Append& append) {
    blocks_.write_rows(count, row_bytes, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
      VtkLegacyNumbers numbers(binary_, bytes);
      for (std::size_t row = begin; row < end; ++row) {
        append(numbers, row);
      }
    });
    if (binary_) {
      text("\n");
    }
  }
  /// A FIELD of the arrays, if there are any. Names that are empty, among `taken_names` or there twice give way to free
  /// ones.
  void field(std::span<const DataArray> arrays, std::span<const std::string> taken_names);
  /// The numbers of the array, and what its description says of it.
  void values(const DataArray& array);

 private:
  bool binary_;
  OrderedBlocks blocks_;
};

/// Writes the document to the plain path `path` as an UNSTRUCTURED_GRID of version 3.0 with every point, cell and
/// array, those with a role (SCALARS, VECTORS, ...) under its keyword: in ASCII, or in BINARY if an array holds NaN or
/// an infinity, which VTK cannot read from text. VTK's own reader gives back the same values bit for bit. Throws
/// WriteError.
void write_vtk_legacy(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

}  // namespace trismooth
