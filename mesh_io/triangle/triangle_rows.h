// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// What the rows of a file of Triangle hold, a line each: their number, and then columns of numbers.
struct TriangleColumns {
  std::size_t reals_before = 0;  ///< coordinates
  std::size_t indices = 0;       ///< of nodes, from first_node to last_node
  std::size_t reals = 0;         ///< attributes
  std::size_t integers = 0;      ///< boundary markers
  std::int64_t first_node = 0;
  std::int64_t last_node = -1;

  std::size_t size() const { return reals_before + indices + reals + integers; }
};

/// The columns of all rows, row by row.
struct TriangleTable {
  std::int32_t first_number = 1;  ///< that the first row has: 0 or 1
  std::vector<double> reals_before;
  std::vector<std::uint64_t> offsets;  ///< byte offsets of reals_before
  std::vector<std::int32_t> indices;   ///< from 0
  std::vector<double> reals;
  std::vector<std::int32_t> integers;
};

/// Reads `count` rows, numbered from 0 or 1 on, from where the scanner stands; `row_name` ("vertex") names one in
/// messages. In parts, by all workers, where the text is plain; the same way everywhere else. Throws ReadError.
TriangleTable read_triangle_rows(TextScanner& scanner, std::size_t count, const TriangleColumns& columns,
                                 std::string_view row_name, const FileWorkers& workers);

}  // namespace trismooth
