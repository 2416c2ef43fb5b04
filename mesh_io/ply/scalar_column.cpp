// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ply/scalar_column.h"

#include <cstring>
#include <memory>
#include <utility>

namespace trismooth {

void ScalarColumn::store(std::size_t row, double value) {
  visit_scalar_type(type_, [&](auto number) {
    number = static_cast<decltype(number)>(value);
    std::memcpy(bytes_.data() + row * sizeof(number), &number, sizeof(number));
  });
}

void ScalarColumn::store_whole(std::size_t row, std::int64_t value) {
  std::memcpy(bytes_.data() + row * sizeof(value), &value, sizeof(value));
}

void ScalarColumn::append(const ScalarColumn& column) {
  bytes_.insert(bytes_.end(), column.bytes_.begin(), column.bytes_.end());
}

void ScalarColumn::append_zeros(std::size_t rows) {
  bytes_.resize(bytes_.size() + rows * size_of(type_));
}

DataArray ScalarColumn::take_array() {
  auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes_));
  bytes_.clear();
  return {std::move(name_), type_, 1, *owner, owner};
}

}  // namespace trismooth
