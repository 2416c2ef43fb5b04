// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/data_array.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "trismooth/mesh_io/scalar_type_of.h"

namespace trismooth {

std::size_t size_of(ScalarType type) {
  return visit_scalar_type(type, [](auto zero) { return sizeof(zero); });
}

std::string_view to_string(ScalarType type) {
  constexpr std::array<std::string_view, 10> names{"int8",   "uint8", "int16",  "uint16",  "int32",
                                                   "uint32", "int64", "uint64", "float32", "float64"};
  return names[static_cast<std::size_t>(type)];
}

double DataArray::value(std::size_t row, std::size_t component) const {
  return visit_scalar_type(type, [&](auto number) {
    std::memcpy(&number, bytes.data() + (row * components + component) * sizeof(number), sizeof(number));
    return static_cast<double>(number);
  });
}

template <class T>
DataArray make_data_array(std::string name, std::size_t components, std::vector<T> values) {
  auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  return {std::move(name), scalar_type_of<T>(), components, std::as_bytes(std::span(*owner)), owner};
}

template DataArray make_data_array(std::string, std::size_t, std::vector<std::int8_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint8_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::int16_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint16_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::int32_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint32_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::int64_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint64_t>);
template DataArray make_data_array(std::string, std::size_t, std::vector<float>);
template DataArray make_data_array(std::string, std::size_t, std::vector<double>);

const DataArray* find_array(std::span<const DataArray> arrays, std::string_view name) {
  const auto found = std::ranges::find(arrays, name, &DataArray::name);
  return found == arrays.end() ? nullptr : &*found;
}

}  // namespace trismooth
