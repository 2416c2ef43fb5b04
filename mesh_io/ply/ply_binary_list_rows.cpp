#include "trismooth/mesh_io/ply/ply_binary_list_rows.h"

#include <cstdint>

#include "trismooth/mesh_io/ply/plain_count.h"

namespace trismooth {

PlyBinaryListRows::PlyBinaryListRows(std::string_view bytes, std::size_t offset, bool swapped,
                                     const PlyElement& element, std::size_t list, const FileWorkers& workers)
    : bytes_(bytes), swapped_(swapped), workers_(workers.workers) {
  const PlyProperty& property = element.properties[list];
  std::size_t before = 0;
  std::size_t behind = 0;
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    (p < list ? before : behind) += p == list ? 0 : size_of(element.properties[p].type);
  }
  const std::size_t item_bytes = size_of(property.type);
  std::size_t item = 0;
  for (std::size_t row = 0; row < element.count; ++row) {
    if (parts_.empty() || offset - begins_.back() >= workers.part_bytes) {
      parts_.push_back({row, row, item, item});
      begins_.push_back(offset);
    }
    if (bytes_.size() - offset < before) {
      return;
    }
    PlyBinaryNumbers numbers(bytes_, offset + before, swapped_);
    const std::int64_t length = next_plain_count(numbers, *property.count_type);
    const std::size_t left = bytes_.size() - numbers.offset();
    if (length < 0 || left < behind || static_cast<std::uint64_t>(length) > (left - behind) / item_bytes) {
      return;
    }
    offset = numbers.offset() + static_cast<std::size_t>(length) * item_bytes + behind;
    item += static_cast<std::size_t>(length);
    parts_.back().last = row + 1;
    parts_.back().last_item = item;
  }
  items_ = item;
}

}  // namespace trismooth
