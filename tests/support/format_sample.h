// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/file_format.h"

#include "support/accepted_files.h"

namespace accepted_files {

namespace cell_type = trismooth::cell_type;

/// What a whole file that was cut has of the mesh.
enum class Rest : std::uint8_t {
  all_cells,
  some_cells,   ///< the last of which may have lost vertices
  lines,        ///< the nodes and elements of the lines that are there, but for the last coordinates
  another_mesh  ///< its last number is a coordinate: cut, it is another one, which no reader can tell
};

/// What tests of all formats have to know of one: files of it, and what is true of them. Each is in formats/, with what
/// makes the files.
struct FormatSample {
  trismooth::FileFormat format;
  /// Adds files of all the format's dialects. Their names begin with the format's.
  void (*add_files)(std::vector<AcceptedFile>& files);
  /// Whether the first `cut` bytes of one of these files are a whole file. Formats without an end or a count end
  /// wherever they are cut, and a last number is whole wherever it is cut.
  bool (*is_whole)(const AcceptedFile& file, std::size_t cut);
  /// Null: all cells.
  Rest (*rest_of)(const AcceptedFile& file) = nullptr;
  /// The types of cells that files hold: groups, in whose order they list them. Empty: all types, in any order.
  std::vector<std::vector<std::uint8_t>> cells{};
  /// Whether files that are written have cells of one of these groups in an order of their own.
  bool has_own_order = false;
  /// Whether files hold cells of one of these types with so many vertices; null: always.
  bool (*holds_cell)(std::uint8_t type, std::size_t vertices) = nullptr;
  /// The point that comes back where that one was written from scratch; null: the same.
  std::array<double, 3> (*written_point)(const std::array<double, 3>& point) = nullptr;
};

/// One of each format, in the order of the enumeration.
const std::vector<FormatSample>& format_samples();

const FormatSample& sample_of(trismooth::FileFormat format);

}  // namespace accepted_files
