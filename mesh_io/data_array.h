// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trismooth {

/// The types of number that mesh files hold.
enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Bytes of one number of the type.
std::size_t size_of(ScalarType type);

/// The type's name in this project's messages and reports: "int8" ... "float64".
std::string_view to_string(ScalarType type);

/// Calls `function` with a value-initialised number of the C++ type that `type` names.
template <class Function>
decltype(auto) visit_scalar_type(ScalarType type, Function&& function) {
  switch (type) {
    case ScalarType::int8:
      return std::forward<Function>(function)(std::int8_t{});
    case ScalarType::uint8:
      return std::forward<Function>(function)(std::uint8_t{});
    case ScalarType::int16:
      return std::forward<Function>(function)(std::int16_t{});
    case ScalarType::uint16:
      return std::forward<Function>(function)(std::uint16_t{});
    case ScalarType::int32:
      return std::forward<Function>(function)(std::int32_t{});
    case ScalarType::uint32:
      return std::forward<Function>(function)(std::uint32_t{});
    case ScalarType::int64:
      return std::forward<Function>(function)(std::int64_t{});
    case ScalarType::uint64:
      return std::forward<Function>(function)(std::uint64_t{});
    case ScalarType::float32:
      return std::forward<Function>(function)(float{});
    case ScalarType::float64:
      break;
  }
  return std::forward<Function>(function)(double{});
}

/// What VTK's formats say of an array under a name, as text: units, a time and the like.
struct ArrayInformation {
  std::string name;                 ///< "UNITS_LABEL"
  std::string location;             ///< the class that the name is from: "vtkDataArray"
  std::vector<std::string> values;  ///< one, or those of a list

  bool operator==(const ArrayInformation&) const = default;
};

/// What a file calls a value of an array: physical groups of Gmsh, markers of SU2, element sets.
struct ValueName {
  std::int64_t value = 0;
  int dimension = 2;  ///< of the cells that have the value under this name: 0 points, 1 lines, 2 faces, 3 solids
  std::string name;

  bool operator==(const ValueName&) const = default;
};

/// What a file says of an array beside its name and numbers.
struct ArrayDescription {
  std::vector<std::string> component_names;   ///< one a component, empty for those without; none where no one has one
  std::vector<ArrayInformation> information;  ///< in the file's order
  std::vector<ValueName> value_names;  ///< of an array of whole numbers, one for each dimension and value at most
  std::vector<std::string> roles;      ///< in which it is the active one of its kind: "Scalars", "Vectors", ...

  /// Whether there is nothing to say.
  bool empty() const { return component_names.empty() && information.empty() && value_names.empty() && roles.empty(); }
  bool operator==(const ArrayDescription&) const = default;
};

/// A named array of numbers of a mesh file, a row of `components` numbers for every point, cell or otherwise. The
/// numbers are in this machine's byte order, rows one after the other. `bytes` views memory that `owner` keeps alive,
/// so a copy is cheap and shares the numbers.
struct DataArray {
  std::string name;
  ScalarType type = ScalarType::float64;
  std::size_t components = 1;
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
  std::shared_ptr<const ArrayDescription> description = nullptr;  ///< null where there is nothing to say

  /// Rows in the array.
  std::size_t rows() const { return components == 0 ? 0 : bytes.size() / (components * size_of(type)); }

  /// The number at `row` and `component`, converted to double (64-bit integers may round). No range check.
  double value(std::size_t row, std::size_t component = 0) const;

  /// The numbers as an array of T, which must be the array's own type: no check.
  template <class T>
  std::span<const T> as() const {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

/// An array that owns `values` (rows x components numbers, row by row).
template <class T>
DataArray make_data_array(std::string name, std::size_t components, std::vector<T> values);

extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::int8_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint8_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::int16_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint16_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::int32_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint32_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::int64_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<std::uint64_t>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<float>);
extern template DataArray make_data_array(std::string, std::size_t, std::vector<double>);

/// The array of that name, or nullptr.
const DataArray* find_array(std::span<const DataArray> arrays, std::string_view name);

}  // namespace trismooth
