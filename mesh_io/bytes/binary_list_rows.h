// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/text/plain_list_rows.h"

namespace trismooth {

/// Binary rows of one list each, of any length.
struct BinaryListLayout {
  std::size_t rows = 0;
  std::size_t bytes_before = 0;  ///< in front of the length
  ScalarType length_type = ScalarType::uint32;
  std::size_t item_bytes = 0;
  std::size_t bytes_behind = 0;  ///< the items
  bool swapped = false;          ///< numbers are not in this machine's byte order
};

/// Reads them in parts, by all workers: PlainListRows of binary files. Where rows begin is found by one worker, which
/// looks at the lengths alone.
class BinaryListRows {
 public:
  /// Looks for the rows from `offset` on. `bytes` must outlive the object.
  BinaryListRows(std::string_view bytes, std::size_t offset, const BinaryListLayout& layout,
                 const FileWorkers& workers);

  /// The items of all lists; nothing where the bytes end before the rows do, or a length is no such number.
  std::optional<std::size_t> items() const { return items_; }

  /// See PlainListRows::read().
  template <class Body>
  std::optional<PlainRows::End> read(const Body& body) const {
    PlainRows::End end{};
    std::atomic<bool> all = true;
    workers_.for_blocks(static_cast<std::int64_t>(parts_.size()), 1, [&](std::int64_t first, std::int64_t last) {
      for (auto number = static_cast<std::size_t>(first); number < static_cast<std::size_t>(last) && all; ++number) {
        BinaryNumbers numbers(bytes_, begins_[number], swapped_);
        if (!body(numbers, parts_[number])) {
          all = false;
        } else if (number + 1 == parts_.size()) {
          end = {numbers.token_offset(), numbers.offset()};
        }
      }
    });
    return all ? std::optional(end) : std::nullopt;
  }

 private:
  std::string_view bytes_;
  bool swapped_;
  Workers& workers_;
  std::vector<PlainListRows::Part> parts_;
  std::vector<std::size_t> begins_;  ///< byte offsets of the parts
  std::optional<std::size_t> items_;
};

}  // namespace trismooth
