// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/array_rows.h"

#include <memory>
#include <utility>
#include <vector>

namespace trismooth {

DataArray with_rows(const DataArray& array, std::span<const std::size_t> rows) {
  const std::size_t row_bytes = array.components * size_of(array.type);
  std::vector<std::byte> bytes;
  bytes.reserve(rows.size() * row_bytes);
  for (const std::size_t row : rows) {
    const auto from = array.bytes.subspan(row * row_bytes, row_bytes);
    bytes.insert(bytes.end(), from.begin(), from.end());
  }
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {array.name, array.type, array.components, *owner, owner, array.description};
}

}  // namespace trismooth
