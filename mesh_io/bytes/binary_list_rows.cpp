// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/binary_list_rows.h"

#include <cstdint>

#include "trismooth/mesh_io/text/plain_count.h"

namespace trismooth {

BinaryListRows::BinaryListRows(std::string_view bytes, std::size_t offset, const BinaryListLayout& layout,
                               const FileWorkers& workers)
    : bytes_(bytes), swapped_(layout.swapped), workers_(workers.workers) {
  std::size_t item = 0;
  for (std::size_t row = 0; row < layout.rows; ++row) {
    if (parts_.empty() || offset - begins_.back() >= workers.part_bytes) {
      parts_.push_back({row, row, item, item});
      begins_.push_back(offset);
    }
    if (bytes_.size() - offset < layout.bytes_before) {
      return;
    }
    BinaryNumbers numbers(bytes_, offset + layout.bytes_before, swapped_);
    const std::int64_t length = next_plain_count(numbers, layout.length_type);
    const std::size_t left = bytes_.size() - numbers.offset();
    if (length < 0 || left < layout.bytes_behind ||
        static_cast<std::uint64_t>(length) > (left - layout.bytes_behind) / layout.item_bytes) {
      return;
    }
    offset = numbers.offset() + static_cast<std::size_t>(length) * layout.item_bytes + layout.bytes_behind;
    item += static_cast<std::size_t>(length);
    parts_.back().last = row + 1;
    parts_.back().last_item = item;
  }
  items_ = item;
}

}  // namespace trismooth
