// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/field_choice.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "trismooth/base/text/suggestion.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/pipeline/fields/name_pattern.h"

namespace trismooth {

namespace {

/// Why an array is never interpolated, or nothing.
std::string_view why_kept(std::string_view name, ScalarType type, const FieldWishes& wishes) {
  if (is_annotation(name)) {
    return "shows what this program found";
  }
  if (!wishes.fixed_array.empty() && name == wishes.fixed_array) {
    return "says which vertices are fixed";
  }
  if (!wishes.size_array.empty() && name == wishes.size_array) {
    return "says which sizes to aim at";
  }
  if (type != ScalarType::float32 && type != ScalarType::float64) {
    return "holds whole numbers";
  }
  return {};
}

/// Adds the arrays that a pattern matches to `chosen`, a flag for each.
void choose_by_pattern(const MeshDocument& document, const FieldWishes& wishes, const std::string& pattern,
                       std::vector<bool>& chosen, std::vector<std::string>& notes) {
  bool matches = false;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const DataArray& array = document.point_arrays[i];
    if (!matches_pattern(pattern, array.name)) {
      continue;
    }
    matches = true;
    const std::string_view why = why_kept(array.name, array.type, wishes);
    chosen[i] = chosen[i] || why.empty();
    if (!why.empty() && !is_wild(pattern)) {
      notes.push_back(fmt::format("the point array '{}' {}: it is not interpolated", array.name, why));
    }
  }
  if (!matches) {
    std::vector<std::string> names;
    for (const DataArray& array : document.point_arrays) {
      names.push_back(array.name);
    }
    throw std::invalid_argument(fmt::format("the file has no point array '{}' to interpolate{}; it has: {}", pattern,
                                            did_you_mean(pattern, names), array_names(document.point_arrays)));
  }
}

}  // namespace

bool stays_unasked(std::string_view name, ScalarType type, const FieldWishes& wishes) {
  return !wishes.fields && wishes.patterns.empty() && why_kept(name, type, wishes).empty();
}

FieldChoice choose_fields(const MeshDocument& document, const FieldWishes& wishes) {
  FieldChoice choice;
  if (wishes.fields == Fields::keep) {
    if (!wishes.patterns.empty()) {
      throw std::invalid_argument("--field-array names arrays to interpolate, but --fields keep keeps them all");
    }
    return choice;
  }
  std::vector<bool> chosen(document.point_arrays.size());
  for (const std::string& pattern : wishes.patterns) {
    choose_by_pattern(document, wishes, pattern, chosen, choice.notes);
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const DataArray& array = document.point_arrays[i];
    const bool is_of_places =
        std::ranges::find(document.arrays_of_places, array.name) != document.arrays_of_places.end();
    const bool is_wanted = wishes.fields == Fields::interpolate && wishes.patterns.empty();
    const std::string_view why = why_kept(array.name, array.type, wishes);
    if (chosen[i] || ((is_of_places || is_wanted) && why.empty())) {
      choice.arrays.push_back(i);
    } else if (is_of_places && wishes.patterns.empty()) {
      choice.notes.push_back(fmt::format("the point array '{}' {}: it is not interpolated", array.name, why));
    } else if (stays_unasked(array.name, array.type, wishes)) {
      choice.kept.push_back(i);
    }
  }
  return choice;
}

}  // namespace trismooth
