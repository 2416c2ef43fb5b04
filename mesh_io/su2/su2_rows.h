// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/su2/su2_elements.h"
#include "trismooth/mesh_io/text/careful_numbers.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"

namespace trismooth {

/// The rows of a section of cells, and what their points are.
struct Su2Cells {
  Su2Section section = Su2Section::elements;
  int dimension = 2;             ///< of the mesh
  std::int32_t first_point = 0;  ///< the point of index 0
  std::int32_t point_count = 0;
  std::string zone{};  ///< that has these points, for messages: "the file"
};

/// Reads rows of points and of cells of an SU2 text from where the scanner stands, which is behind them then: in parts,
/// by all workers, where all of them have the same numbers behind them. Throws ReadError.
class Su2Rows {
 public:
  /// The scanner must outlive the object.
  Su2Rows(TextScanner& scanner, const FileWorkers& workers) : scanner_(scanner), plain_(scanner.text(), workers) {}

  /// The points from number `first` on, which fill the document's points and the sites to their end. The columns of the
  /// sites are the dimension.
  void read_points(std::size_t first, MeshDocument& document, NumberSites& sites);

  /// `count` cells, behind the list's.
  void read_cells(const Su2Cells& of, std::size_t count, CellList& cells);

 private:
  /// A cell of one row.
  struct Cell {
    std::int64_t type = 0;
    std::size_t points = 0;
    std::array<std::int32_t, 4> vertices{};
  };
  /// Which row it is, for messages.
  struct Row {
    std::string_view kind;
    std::size_t number;
    std::size_t count;
  };

  template <class Numbers>
  bool read_cell(Numbers& numbers, const Su2Cells& of, const Row& row, Cell& cell) const;
  bool read_plain_cells(const Su2Cells& of, std::size_t count, CellList& cells);

  bool end_point(PlainNumbers& numbers, const Row& row) const;
  bool end_point(CarefulNumbers& numbers, const Row& row) const;
  bool end_cell(PlainNumbers& numbers, const Row& row, std::size_t points) const;
  bool end_cell(CarefulNumbers& numbers, const Row& row, std::size_t points) const;

  TextScanner& scanner_;
  PlainRows plain_;
  std::size_t others_ = 0;  ///< numbers behind those of a plain row that are read
};

}  // namespace trismooth
