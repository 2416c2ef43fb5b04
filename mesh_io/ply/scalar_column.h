// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// A one-component array under construction, of a type that is known only when a file's header has been read.
/// Rows are 0 until they are stored.
class ScalarColumn {
 public:
  /// An array of `rows` rows.
  ScalarColumn(std::string name, ScalarType type, std::size_t rows)
      : name_(std::move(name)), type_(type), bytes_(rows * size_of(type)) {}

  const std::string& name() const { return name_; }
  ScalarType type() const { return type_; }

  /// Sets a row to `value`, which the column's type must be able to hold: no check.
  void store(std::size_t row, double value);

  /// Sets a row of a column of a 64-bit integer type; of uint64, numbers of 2^63 or more are given less 2^64.
  void store_whole(std::size_t row, std::int64_t value);

  /// Sets a row to a number of the column's own type.
  template <class T>
  void put(std::size_t row, T value) {
    std::memcpy(bytes_.data() + row * sizeof(value), &value, sizeof(value));
  }

  /// Adds the rows of another column of the same type at the end.
  void append(const ScalarColumn& column);

  /// Adds `rows` rows of 0 at the end.
  void append_zeros(std::size_t rows);

  /// The finished array; the column is empty after that.
  DataArray take_array();

 private:
  std::string name_;
  ScalarType type_;
  std::vector<std::byte> bytes_;
};

/// The columns that hold scalar properties of an element, at the properties' positions; nothing where a property is a
/// list, or is held elsewhere.
using ScalarColumns = std::vector<std::optional<ScalarColumn>>;

}  // namespace trismooth
