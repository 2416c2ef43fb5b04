// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/place_values.h"

#include <algorithm>
#include <cmath>

#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/mesh_io/selafin/selafin_names.h"

namespace trismooth {

namespace {

bool holds_place_values(const DataArray& array) {
  if (array.components != 1) {
    return false;
  }
  for (std::size_t row = 0; row < array.rows(); ++row) {
    if (std::isinf(array.value(row))) {
      return false;
    }
  }
  return true;
}

PlaceValues values_from(const DataArray& array, bool negated) {
  PlaceValues found{.array = array.name, .values = std::vector<double>(array.rows())};
  for (std::size_t row = 0; row < found.values.size(); ++row) {
    // Not -value: the other sign of 0 is 0.
    found.values[row] = negated ? 0 - array.value(row) : array.value(row);
  }
  return found;
}

std::string_view name_of_place_value(PlaceValue value) {
  return value == PlaceValue::depth ? "depth" : "elevation";
}

/// With those of TELEMAC, which is English or French.
std::vector<std::string_view> names_of_place_value(PlaceValue value) {
  return value == PlaceValue::depth ? std::vector<std::string_view>{"depth"}
                                    : std::vector<std::string_view>{"elevation", "BOTTOM", "FOND"};
}

}  // namespace

PlaceValues find_place_values(const MeshDocument& document, PlaceValue wanted) {
  const PlaceValue other = wanted == PlaceValue::depth ? PlaceValue::elevation : PlaceValue::depth;
  for (const PlaceValue value : {wanted, other}) {
    for (const std::string_view name : names_of_place_value(value)) {
      const DataArray* const array = find_array_loosely(document.point_arrays, name);
      if (array != nullptr && holds_place_values(*array)) {
        return values_from(*array, value != wanted);
      }
    }
  }
  if (document.arrays_of_places.size() == 1) {
    const DataArray* const array = find_array(document.point_arrays, document.arrays_of_places.front());
    if (array != nullptr && holds_place_values(*array)) {
      return values_from(*array, false);
    }
  }
  return {.array = {}, .values = std::vector<double>(document.point_count(), 0)};
}

std::vector<std::string> written_place_arrays(const MeshDocument& document, FileFormat target) {
  if (target != FileFormat::adcirc && target != FileFormat::sms && target != FileFormat::selafin) {
    return {};
  }
  std::vector<std::string> names;
  for (const DataArray& array : document.point_arrays) {
    if (target == FileFormat::selafin && is_selafin_place_value(array.name)) {
      names.push_back(array.name);
    }
  }
  const PlaceValue wanted = target == FileFormat::adcirc ? PlaceValue::depth : PlaceValue::elevation;
  if (const std::string name = names.empty() ? find_place_values(document, wanted).array : ""; !name.empty()) {
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> describe_missing_place_values(std::string_view format, const MeshDocument& document,
                                                       PlaceValue wanted) {
  if (!find_place_values(document, wanted).array.empty()) {
    return {};
  }
  const std::string name(name_of_place_value(wanted));
  return {std::string(format) + " holds a" + (wanted == PlaceValue::elevation ? "n " : " ") + name +
          " for each point: 0 is written, since there is no point array " + name};
}

}  // namespace trismooth
