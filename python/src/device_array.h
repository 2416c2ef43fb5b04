// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "trismooth/cuda/primitives/strided_rows.h"

namespace trismooth::python {

/// An array in memory of a CUDA device, by DLPack: nothing is copied. Keeps the memory until it is destroyed, with the
/// GIL.
class DeviceArray {
 public:
  /// `capsule` is of the caller's `__dlpack__()`. Raises TypeError for what is no such array or no plain numbers,
  /// ValueError for one in memory of the host.
  DeviceArray(nanobind::handle capsule, std::string argument);

  const std::string& argument() const { return argument_; }
  /// 'f', 'i', 'u', '?'; 0 for what is none of these.
  char kind() const;
  std::size_t item_size() const { return array_.dtype().bits / 8U; }
  std::size_t dimensions() const { return array_.ndim(); }
  std::size_t extent(std::size_t dimension) const { return array_.shape(dimension); }
  int device() const { return array_.device_id(); }
  std::byte* data() const { return static_cast<std::byte*>(array_.data()); }
  std::string shape_text() const;
  std::string type_text() const;

  /// `columns` of its rows from column `first` on; an array of one dimension has one.
  cuda::StridedRows rows(std::int32_t columns, std::int32_t first = 0) const;
  /// Whether the rows are of so many columns and lie one behind the other, at a multiple of `alignment` bytes.
  bool is_packed(std::size_t columns, std::size_t alignment) const;

  [[noreturn]] void raise_value(const std::string& what) const;
  [[noreturn]] void raise_type(const std::string& what) const;
  /// Raises ValueError unless it is on that device.
  void require_device(int device) const;

 private:
  nanobind::ndarray<> array_;
  std::string argument_;
};

}  // namespace trismooth::python
