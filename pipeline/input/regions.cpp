// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/regions.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/pipeline/input/inner_edges.h"
#include "trismooth/pipeline/input/value_names.h"
#include "trismooth/pipeline/input/value_numbers.h"

namespace trismooth {

namespace {

/// An array of numbers, or of texts by their numbers.
struct Candidate {
  DataArray array;
  const LabelArray* labels = nullptr;
  ValueNames names{array, 2};

  /// The value in a row, or what it is called; `with_value`: both.
  std::string text(std::size_t row, bool with_value) const {
    if (labels != nullptr) {
      return labels->labels[static_cast<std::size_t>(labels->of_row[row])];
    }
    std::string value = value_text(array, row);
    const std::string name = names.of(value);
    if (name.empty()) {
      return value;
    }
    return with_value ? name + " (" + value + ")" : name;
  }
};

/// The document's cell arrays, those of texts last. The candidates view the document.
std::vector<Candidate> candidates_of(const MeshDocument& document) {
  std::vector<Candidate> candidates;
  candidates.reserve(document.cell_arrays.size() + document.cell_labels.size());
  for (const DataArray& array : document.cell_arrays) {
    candidates.push_back({array, nullptr});
  }
  for (const LabelArray& labels : document.cell_labels) {
    candidates.push_back(
        {{labels.name, ScalarType::int32, 1, std::as_bytes(std::span(labels.of_row)), nullptr}, &labels});
  }
  return candidates;
}

class RegionFinder {
 public:
  RegionFinder(const MeshDocument& document, const ElementCells& mesh)
      : mesh_(mesh), candidates_(candidates_of(document)), edges_(mesh.elements, document.point_count()) {
    if (!mesh.copies.empty()) {
      rows_.assign(mesh.cells.begin(), mesh.cells.end());
      for (const CellCopy& copy : mesh.copies) {
        rows_.push_back(copy.cell);
        copy_of_.push_back(copy.element);
      }
      copies_by_triangle_ = mesh.copies;
      std::ranges::sort(copies_by_triangle_, {},
                        [](const CellCopy& copy) { return std::pair(copy.element, copy.cell); });
      has_several_.assign(mesh.cells.size(), 0);
    }
  }

  Regions find(std::span<const std::string> names, std::string_view sizes, const ArrayOwner& owner) {
    std::vector<TriangleValues> arrays;
    std::ranges::transform(candidates_, std::back_inserter(arrays),
                           [this](const Candidate& candidate) { return values_of(candidate); });
    choose_regions(
        arrays, names, sizes, [&](std::size_t place, RegionReason reason) { obey(candidates_[place], reason); },
        regions_.notes, owner);
    return take();
  }

 private:
  TriangleValues values_of(const Candidate& candidate) {
    return {candidate.array.name,
            candidate.array.components,
            static_cast<std::int64_t>(mesh_.elements.size()),
            [this, &candidate] { return numbers_of(candidate).count() > 1; },
            [this, &candidate] { return std::int64_t{numbers_of(candidate).count()}; },
            [this, &candidate] { return has_whole_numbers(candidate.array, numbers_of(candidate)); },
            [this, &candidate] { return edges_.vertices_between(numbers_of(candidate).of_item); },
            [this, &candidate] { return edges_.fraction_between(numbers_of(candidate).of_item); }};
  }

  /// Those of one array at a time are kept.
  const ValueNumbers& numbers_of(const Candidate& candidate) {
    if (numbered_ != &candidate) {
      last_numbers_ = {};
      last_numbers_ = numbers_at_triangles(candidate.array);
      numbered_ = &candidate;
    }
    return last_numbers_;
  }

  /// A triangle that is listed with several values has the set of them, which is a value of its own: where groups
  /// overlap, what is in both has a border with what is in one.
  ValueNumbers numbers_at_triangles(const DataArray& array) const {
    return mesh_.copies.empty() ? number_values(array, mesh_.cells)
                                : join_copies(number_values(array, rows_), copy_of_);
  }

  bool has_whole_numbers(const DataArray& array, const ValueNumbers& numbers) const {
    return mesh_.copies.empty() ? are_whole(array, mesh_.cells, numbers)
                                : are_whole(array, rows_, number_values(array, rows_));
  }

  void obey(const Candidate& candidate, RegionReason reason) {
    const ValueNumbers& numbers = numbers_of(candidate);
    regions_.arrays.push_back(
        {candidate.array.name, reason, numbers.count(), edges_.vertices_between(numbers.of_item)});
    mark_several(candidate.array);
    obeyed_.push_back(&candidate);
    if (obeyed_.size() == 1) {
      numbers_ = std::move(last_numbers_);
      numbered_ = nullptr;
    } else {
      numbers_ = number_pairs(numbers_, numbers);
    }
  }

  void mark_several(const DataArray& array) {
    const ValueNumbers listed = mesh_.copies.empty() ? ValueNumbers{} : number_values(array, rows_);
    for (std::size_t i = 0; i < copy_of_.size(); ++i) {
      const auto first = static_cast<std::size_t>(copy_of_[i]);
      if (listed.of_item[mesh_.cells.size() + i] != listed.of_item[first]) {
        has_several_[first] = 1;
      }
    }
  }

  Regions take() {
    if (const auto several = std::ranges::count(has_several_, 1); several > 0) {
      const std::string kind(kind_of_elements(mesh_));
      regions_.notes.push_back(
          counted(several, kind + " is", kind + "s are") +
          " listed in several regions: what these share is a region of its own, whose border is held; --region-array "
          "none switches regions off");
    }
    std::vector<RegionName> names;
    names.reserve(numbers_.example.size());
    for (const std::int32_t triangle : numbers_.example) {
      names.push_back({name_of_region(triangle, false), name_of_region(triangle, true)});
    }
    regions_.names = tell_apart(std::move(names));
    regions_.of_triangle = std::move(numbers_.of_item);
    return std::move(regions_);
  }

  std::string name_of_region(std::int32_t triangle, bool with_values) const {
    return list_text(obeyed_, [&](const Candidate* candidate) { return text_of(*candidate, triangle, with_values); });
  }

  /// The value of a triangle, or what it is called; of one that is listed with several, all of them.
  std::string text_of(const Candidate& candidate, std::int32_t triangle, bool with_value) const {
    std::string text =
        candidate.text(static_cast<std::size_t>(mesh_.cells[static_cast<std::size_t>(triangle)]), with_value);
    std::set<std::string> said{text};
    const auto first = std::ranges::lower_bound(copies_by_triangle_, triangle, {}, &CellCopy::element);
    for (auto copy = first; copy != copies_by_triangle_.end() && copy->element == triangle; ++copy) {
      if (const auto [other, is_new] = said.insert(candidate.text(static_cast<std::size_t>(copy->cell), with_value));
          is_new) {
        text.append(" + ").append(*other);
      }
    }
    return text;
  }

  const ElementCells& mesh_;
  std::vector<Candidate> candidates_;
  InnerEdges edges_;
  Regions regions_;
  std::vector<const Candidate*> obeyed_;
  ValueNumbers numbers_;                 ///< the triangles by the values of all obeyed arrays
  ValueNumbers last_numbers_;            ///< by those of the array that was asked for last
  const Candidate* numbered_ = nullptr;  ///< that one

  // Of a mesh with triangles that are listed again; else empty.
  std::vector<std::int32_t> rows_;            ///< the cells of the triangles, then those of their copies
  std::vector<std::int32_t> copy_of_;         ///< one triangle for each of these
  std::vector<CellCopy> copies_by_triangle_;  ///< those of a triangle in the document's order
  std::vector<std::uint8_t> has_several_;     ///< per triangle: 1 where arrays that were obeyed give it several values
};

}  // namespace

Regions find_regions(const MeshDocument& document, const ElementCells& mesh, std::span<const std::string> names,
                     std::string_view sizes, const ArrayOwner& owner) {
  return RegionFinder(document, mesh).find(names, sizes, owner);
}

}  // namespace trismooth
