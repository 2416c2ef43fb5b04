// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"
#include "trismooth/mesh_io/text/plain_rows.h"

namespace trismooth {

/// A list of rows of equally many numbers, as MSH files hold them.
struct MshRowLayout {
  std::size_t rows = 0;
  std::size_t numbers = 0;  ///< of a row
  std::size_t bytes = 0;    ///< of a row in a binary file
};

/// Reads such lists by all workers, of files of either kind, where nothing is unusual in them.
class MshRows {
 public:
  MshRows(MshInput& input, const FileWorkers& workers)
      : input_(input), workers_(workers), plain_(input.bytes(), workers) {}

  /// Calls body(numbers, first, last) for parts of the rows behind the place where the input stands, which reads rows
  /// first to last - 1 from `numbers` (PlainNumbers or BinaryNumbers) and answers false where it cannot. Where all were
  /// read the input stands behind them and the answer is true; else nothing has changed.
  template <class Body>
  bool read(const MshRowLayout& layout, const Body& body) {
    if (input_.header().binary) {
      return read_binary(layout, body);
    }
    if (layout.rows == 0) {
      return false;
    }
    const auto end = plain_.read(input_.offset(), layout.rows, layout.numbers, body);
    if (end) {
      input_.text().resume(end->last_number, end->offset);
    }
    return end.has_value();
  }

  /// read() of a binary file: `numbers` are BinaryNumbers.
  template <class Body>
  bool read_binary(const MshRowLayout& layout, const Body& body) {
    if (workers_.part_bytes == FileWorkers::serial || layout.rows == 0 ||
        layout.rows > input_.bytes_left() / layout.bytes) {
      return false;
    }
    const std::size_t begin = input_.offset();
    const bool all = all_file_blocks(workers_, layout.rows, layout.bytes, [&](std::size_t first, std::size_t last) {
      BinaryNumbers numbers(input_.bytes(), begin + first * layout.bytes, input_.header().swapped);
      return body(numbers, first, last);
    });
    if (all) {
      input_.seek(begin + layout.rows * layout.bytes);
    }
    return all;
  }

  /// read() of rows of a text that are a list each (see read_plain_lists).
  template <class MakeRoom, class ReadPart>
  bool read_lists(std::size_t rows, const PlainListShape& shape, const MakeRoom& make_room, const ReadPart& read_part) {
    const auto end = read_plain_lists(plain_, input_.offset(), rows, shape, true, make_room, read_part);
    if (end) {
      input_.text().resume(end->last_number, end->offset);
    }
    return end.has_value();
  }

  void seek(std::size_t offset) { input_.seek(offset); }
  const FileWorkers& workers() const { return workers_; }

 private:
  MshInput& input_;
  FileWorkers workers_;
  PlainRows plain_;
};

/// Makes room for more values at the end of two vectors, in steps that double, by all workers.
template <class A, class B>
void grow_shared(std::vector<A>& a, std::size_t size_of_a, std::vector<B>& b, std::size_t size_of_b, Workers& workers) {
  const auto reserve = [&workers](auto& values, std::size_t size) {
    if (size > values.capacity()) {
      shared_reserve(values, std::max(size, 2 * values.capacity()), workers);
    }
  };
  reserve(a, size_of_a);
  reserve(b, size_of_b);
  shared_resize(a, size_of_a, b, size_of_b, workers);
}

}  // namespace trismooth
