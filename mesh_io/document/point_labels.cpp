// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/point_labels.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/region_names.h"

namespace trismooth {

namespace {

bool has_a_label_a_row(const DataArray& array) {
  return array.components == 1 && array.type != ScalarType::float32 && array.type != ScalarType::float64;
}

}  // namespace

const DataArray* find_point_labels(const MeshDocument& document) {
  const auto found = std::ranges::find_if(document.point_arrays, [](const DataArray& array) {
    return has_a_label_a_row(array) && is_region_name(array.name);
  });
  return found == document.point_arrays.end() ? nullptr : &*found;
}

std::int64_t point_label(const DataArray& labels, std::size_t point) {
  return visit_scalar_type(labels.type, [&](auto number) {
    std::memcpy(&number, labels.bytes.data() + point * sizeof(number), sizeof(number));
    return static_cast<std::int64_t>(number);
  });
}

std::vector<std::string> describe_unlabelled_arrays(std::string_view format, const MeshDocument& document,
                                                    const DataArray* labels, const CellGroups& groups) {
  MeshDocument rest;
  for (const DataArray& array : document.point_arrays) {
    if (&array != labels) {
      rest.point_arrays.push_back(array);
    }
  }
  MeshDocument named;
  for (const DataArray& array : document.cell_arrays) {
    (groups.arrays.has(array.name) ? named : rest).cell_arrays.push_back(array);
  }
  rest.field_arrays = document.field_arrays;
  std::vector<std::string> sentences = describe_lost_arrays(format, rest);
  std::ranges::move(describe_lost_names(format, named), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
