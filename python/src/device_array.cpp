// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/device_array.h"

#include <cstdint>
#include <utility>

#include "trismooth/python/errors.h"
#include "trismooth/python/text.h"

namespace nb = nanobind;

namespace trismooth::python {

DeviceArray::DeviceArray(nb::handle capsule, std::string argument) : argument_(std::move(argument)) {
  if (!nb::try_cast(capsule, array_)) {
    raise_type_error(argument_, "an array is needed");
  }
  if (array_.device_type() != nb::device::cuda::value && array_.device_type() != nb::device::cuda_managed::value) {
    raise_value("is in memory of the host; points are on a CUDA device");
  }
  if (kind() == 0 || array_.dtype().lanes != 1) {
    raise_type("its elements are no plain numbers");
  }
}

char DeviceArray::kind() const {
  switch (static_cast<nb::dlpack::dtype_code>(array_.dtype().code)) {
    case nb::dlpack::dtype_code::Float:
      return 'f';
    case nb::dlpack::dtype_code::Int:
      return 'i';
    case nb::dlpack::dtype_code::UInt:
      return 'u';
    case nb::dlpack::dtype_code::Bool:
      return '?';
    default:
      return 0;
  }
}

std::string DeviceArray::shape_text() const {
  return shape_text_of(*this);
}

std::string DeviceArray::type_text() const {
  return type_text_of(*this, kind());
}

cuda::StridedRows DeviceArray::rows(std::int32_t columns, std::int32_t first) const {
  const auto size = static_cast<std::int64_t>(item_size());
  const std::int64_t column_stride = dimensions() > 1 ? array_.stride(1) * size : size;
  return {data() + first * column_stride, static_cast<std::int64_t>(extent(0)), columns, array_.stride(0) * size,
          column_stride};
}

bool DeviceArray::is_packed(std::size_t columns, std::size_t alignment) const {
  if (reinterpret_cast<std::uintptr_t>(data()) % alignment != 0) {
    return false;
  }
  const bool is_list = dimensions() == 1 && columns == 1;
  if (!is_list && (dimensions() != 2 || extent(1) != columns)) {
    return false;
  }
  const auto follows = [this](std::size_t dimension, std::size_t stride) {
    return extent(dimension) <= 1 || array_.stride(dimension) == static_cast<std::int64_t>(stride);
  };
  return follows(0, columns) && (is_list || follows(1, 1));
}

void DeviceArray::raise_value(const std::string& what) const {
  raise_value_error(argument_, what);
}

void DeviceArray::raise_type(const std::string& what) const {
  raise_type_error(argument_, what);
}

void DeviceArray::require_device(int device) const {
  if (this->device() != device) {
    raise_value("is on cuda:" + std::to_string(this->device()) + ", and points are on cuda:" + std::to_string(device));
  }
}

}  // namespace trismooth::python
