// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/format_losses.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/array_components.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"

namespace trismooth {

namespace {

template <class IsHeld>
std::vector<const DataArray*> arrays_but(const IsHeld& is_held, const std::vector<DataArray>& arrays) {
  std::vector<const DataArray*> others;
  for (const DataArray& array : arrays) {
    if (!is_held(array.name)) {
      others.push_back(&array);
    }
  }
  return others;
}

/// Adds the sentence for arrays or sets, if there are any.
template <class All, class Name>
void describe(std::vector<std::string>& sentences, std::string_view format, std::string_view what, const All& all,
              const Name& name) {
  if (!all.empty()) {
    sentences.push_back(std::string(format) + " holds no " + std::string(what) + ": " + list_text(all, name) +
                        not_written(all.size()));
  }
}

}  // namespace

std::vector<std::string> describe_lost_arrays(std::string_view format, const MeshDocument& document,
                                              const HeldArrays& held) {
  std::vector<std::string> sentences;
  const auto tell_of = [&](std::string_view what, const std::vector<const DataArray*>& arrays) {
    describe(sentences, format, what, arrays, [](const DataArray* array) { return shown_name(*array); });
  };
  tell_of("point arrays",
          arrays_but([&held](const std::string& name) { return held.point == name; }, document.point_arrays));
  tell_of("cell arrays",
          arrays_but([&held](const std::string& name) { return held.cell.has(name); }, document.cell_arrays));
  std::ranges::move(describe_lost_field_arrays(format, document), std::back_inserter(sentences));
  return sentences;
}

std::vector<std::string> describe_lost_field_arrays(std::string_view format, const MeshDocument& document) {
  std::vector<std::string> sentences;
  describe(sentences, format, "field arrays", document.field_arrays, shown_name<DataArray>);
  return sentences;
}

std::vector<std::string> describe_lost_names(std::string_view format, const MeshDocument& document,
                                             const GroupArrays& held) {
  std::string arrays;
  for (const DataArray& array : document.cell_arrays) {
    if (!held.has(array.name) && array.description != nullptr && !array.description->value_names.empty()) {
      add_to_list(arrays, array.name);
    }
  }
  if (arrays.empty()) {
    return {};
  }
  return {std::string(format) + " holds no names of values: those of " + arrays + " are not written"};
}

std::vector<std::string> describe_lost_units(std::string_view format, const MeshDocument& document) {
  std::string arrays;
  for (const auto* const all : {&document.point_arrays, &document.cell_arrays, &document.field_arrays}) {
    for (const DataArray& array : *all) {
      if (!unit_of(array).empty()) {
        add_to_list(arrays, shown_name(array));
      }
    }
  }
  if (arrays.empty()) {
    return {};
  }
  return {std::string(format) + " holds no units: those of " + arrays + " are not written"};
}

std::vector<std::string> describe_rounded(std::string_view format, std::string_view holds,
                                          std::span<const DataArray* const> arrays) {
  std::vector<const DataArray*> rounded;
  std::ranges::copy_if(arrays, std::back_inserter(rounded),
                       [](const DataArray* array) { return !is_exact_as_double(*array); });
  if (rounded.empty()) {
    return {};
  }
  return {std::string(format) + " holds " + std::string(holds) + ": " +
          list_text(rounded, [](const DataArray* array) { return shown_name(*array); }) +
          (rounded.size() == 1 ? " is rounded" : " are rounded")};
}

std::vector<std::string> describe_widened(std::string_view format, const MeshDocument& document,
                                          const GroupArrays& but) {
  std::vector<const DataArray*> widened;
  for (const auto* const arrays : {&document.point_arrays, &document.cell_arrays}) {
    for (const DataArray& array : *arrays) {
      const bool is_group = arrays == &document.cell_arrays && but.has(array.name);
      if (array.type == ScalarType::uint64 && widened_type(array) == ScalarType::float64 && !is_group) {
        widened.push_back(&array);
      }
    }
  }
  return describe_rounded(format, "whole numbers below 2^63", widened);
}

std::vector<std::string> describe_lost_sets(std::string_view format, const MeshDocument& document) {
  std::vector<std::string> sentences;
  describe(sentences, format, "sets of points", document.point_sets, shown_name<NamedSet>);
  describe(sentences, format, "sets of cells", document.cell_sets, shown_name<NamedSet>);
  return sentences;
}

std::vector<std::string> describe_new_order(std::string_view format, std::span<const std::uint8_t> written_types,
                                            const CellList& cells) {
  std::array<std::size_t, 256> places{};
  for (std::size_t place = 0; place < written_types.size(); ++place) {
    places[written_types[place]] = place + 1;
  }
  std::size_t last = 0;
  for (const std::uint8_t type : cells.types) {
    const std::size_t place = places[type];
    if (place != 0 && place < last) {
      return {std::string(format) + " lists cells by their type: they are written in another order"};
    }
    last = std::max(last, place);
  }
  return {};
}

std::vector<std::string> describe_lost_cells(std::string_view format, std::string_view holds,
                                             std::span<const std::uint8_t> written_types, const CellList& cells) {
  const std::array<std::size_t, 256> counts = count_other_cells(cells, written_types);
  std::string lost;
  std::size_t total = 0;
  for (std::size_t type = 0; type < counts.size(); ++type) {
    if (counts[type] > 0) {
      add_to_list(lost, counted(counts[type], "cell of type ", "cells of type ") + cell_type_name(type));
      total += counts[type];
    }
  }
  if (lost.empty()) {
    return {};
  }
  return {std::string(format) + " holds " + std::string(holds) + " only: " + lost + not_written(total)};
}

}  // namespace trismooth
