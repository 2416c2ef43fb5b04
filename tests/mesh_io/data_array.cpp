// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/data_array.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "catch.h"

using trismooth::DataArray;
using trismooth::find_array;
using trismooth::make_data_array;
using trismooth::ScalarType;
using trismooth::size_of;

namespace {

template <class T>
void check_type(ScalarType type, const std::string& name) {
  CAPTURE(name);
  CHECK(trismooth::to_string(type) == name);
  CHECK(size_of(type) == sizeof(T));
  const T low = std::numeric_limits<T>::lowest();
  const T high = std::numeric_limits<T>::max();
  const DataArray array = make_data_array("a", 2, std::vector<T>{low, high, T(1), T(0), T(7), T(9)});
  CHECK(array.type == type);
  CHECK(array.rows() == 3);
  CHECK(array.value(0, 0) == static_cast<double>(low));
  CHECK(array.value(0, 1) == static_cast<double>(high));
  CHECK(array.value(2) == 7);
  CHECK(array.value(2, 1) == 9);
  CHECK(array.as<T>().size() == 6);
  CHECK(array.as<T>()[0] == low);
}

}  // namespace

TEST_CASE("an array knows its type of number and gives every value of it") {
  check_type<std::int8_t>(ScalarType::int8, "int8");
  check_type<std::uint8_t>(ScalarType::uint8, "uint8");
  check_type<std::int16_t>(ScalarType::int16, "int16");
  check_type<std::uint16_t>(ScalarType::uint16, "uint16");
  check_type<std::int32_t>(ScalarType::int32, "int32");
  check_type<std::uint32_t>(ScalarType::uint32, "uint32");
  check_type<std::int64_t>(ScalarType::int64, "int64");
  check_type<std::uint64_t>(ScalarType::uint64, "uint64");
  check_type<float>(ScalarType::float32, "float32");
  check_type<double>(ScalarType::float64, "float64");
}

TEST_CASE("values are read from bytes at any address") {
  // The one byte in front shifts the numbers off their alignment, as in the middle of a file.
  const std::vector<double> numbers{0.1, -2};
  std::vector<std::byte> bytes(1 + sizeof(double) * numbers.size());
  const auto raw = std::as_bytes(std::span(numbers));
  std::copy(raw.begin(), raw.end(), bytes.begin() + 1);
  const DataArray array{"a", ScalarType::float64, 1, std::span(bytes).subspan(1), nullptr};
  CHECK(array.value(0) == 0.1);
  CHECK(array.value(1) == -2);
}

TEST_CASE("a copy shares the numbers and keeps them alive") {
  DataArray copy;
  const std::byte* address = nullptr;
  {
    const DataArray array = make_data_array("a", 1, std::vector<std::int32_t>{3, 4});
    copy = array;
    address = array.bytes.data();
  }
  CHECK(copy.bytes.data() == address);
  CHECK(copy.value(1) == 4);
}

TEST_CASE("an array without numbers or without components has no rows") {
  CHECK(make_data_array("a", 3, std::vector<float>{}).rows() == 0);
  CHECK(DataArray{}.rows() == 0);
  CHECK(make_data_array("a", 0, std::vector<float>{}).rows() == 0);
}

TEST_CASE("an array is found by its whole name, the first of equal ones") {
  const std::vector<DataArray> arrays{make_data_array("region", 1, std::vector<float>{1}),
                                      make_data_array("", 1, std::vector<float>{2}),
                                      make_data_array("region", 1, std::vector<float>{3})};
  CHECK(find_array(arrays, "region") == &arrays[0]);
  CHECK(find_array(arrays, "") == &arrays[1]);
  CHECK(find_array(arrays, "Region") == nullptr);
  CHECK(find_array(arrays, "reg") == nullptr);
  CHECK(find_array({}, "region") == nullptr);
}
