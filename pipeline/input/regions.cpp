#include "trismooth/pipeline/input/regions.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/pipeline/input/inner_edges.h"
#include "trismooth/pipeline/input/region_judge.h"
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

std::string names_of(const std::vector<Candidate>& candidates) {
  std::vector<DataArray> arrays;
  std::ranges::transform(candidates, std::back_inserter(arrays), &Candidate::array);
  return array_names(arrays);
}

class RegionFinder {
 public:
  RegionFinder(const MeshDocument& document, const PlanarMesh& mesh)
      : mesh_(mesh), candidates_(candidates_of(document)), edges_(mesh.triangles, mesh.points.size()) {}

  Regions by_names(std::span<const std::string> names) {
    for (const std::string& name : names) {
      for (const Candidate* const candidate : named(name)) {
        if (candidate->array.components != 1) {
          throw std::invalid_argument(fmt::format("the cell array '{}' has {} components; regions need one",
                                                  candidate->array.name, candidate->array.components));
        }
        if (std::ranges::find(obeyed_, candidate) == obeyed_.end()) {
          obey(*candidate, number_values(candidate->array, mesh_.cells), RegionReason::named);
        }
      }
    }
    return take();
  }

  Regions by_document(std::string_view sizes) {
    for (const Candidate& candidate : candidates_) {
      if (!is_annotation(candidate.array.name) && (sizes.empty() || candidate.array.name != sizes)) {
        judge(candidate);
      }
    }
    if (regions_.arrays.empty() && constant_ != nullptr) {
      obey(*constant_, number_values(constant_->array, mesh_.cells), RegionReason::known_name);
    }
    return take();
  }

 private:
  /// All arrays of that name, or else of names that differ from it in case, blanks and the like.
  std::vector<const Candidate*> named(const std::string& name) const {
    std::vector<const Candidate*> found;
    const auto find = [&](const auto& same) {
      for (const Candidate& candidate : candidates_) {
        if (same(candidate.array.name)) {
          found.push_back(&candidate);
        }
      }
    };
    find([&](const std::string& other) { return other == name; });
    if (found.empty()) {
      find([plain = plain_name(name)](const std::string& other) { return plain_name(other) == plain; });
    }
    if (found.empty()) {
      throw std::invalid_argument("the file has no cell array '" + name +
                                  "' to take regions from; it has: " + names_of(candidates_));
    }
    return found;
  }

  void judge(const Candidate& candidate) {
    ValueNumbers numbers =
        candidate.array.components == 1 ? number_values(candidate.array, mesh_.cells) : ValueNumbers{};
    const TriangleValues values{candidate.array.name,
                                candidate.array.components,
                                std::ssize(mesh_.triangles),
                                [&] { return numbers.count() > 1; },
                                [&] { return std::int64_t{numbers.count()}; },
                                [&] { return are_whole(candidate.array, mesh_.cells, numbers); },
                                [&] { return edges_.vertices_between(numbers.of_item); },
                                [&] { return edges_.fraction_between(numbers.of_item); }};
    if (const auto reason = judge_regions(values, regions_.notes)) {
      obey(candidate, std::move(numbers), *reason);
    } else if (constant_ == nullptr && is_constant_region(values)) {
      constant_ = &candidate;
    }
  }

  void obey(const Candidate& candidate, ValueNumbers numbers, RegionReason reason) {
    regions_.arrays.push_back(
        {candidate.array.name, reason, numbers.count(), edges_.vertices_between(numbers.of_item)});
    obeyed_.push_back(&candidate);
    numbers_ = obeyed_.size() == 1 ? std::move(numbers) : number_pairs(numbers_, numbers);
  }

  Regions take() {
    std::unordered_map<std::string, int> uses;
    for (const std::int32_t triangle : numbers_.example) {
      regions_.names.push_back(name_of_region(triangle, false));
      ++uses[regions_.names.back()];
    }
    for (std::size_t r = 0; r < regions_.names.size(); ++r) {
      if (uses[regions_.names[r]] > 1) {
        regions_.names[r] = name_of_region(numbers_.example[r], true);
      }
    }
    regions_.of_triangle = std::move(numbers_.of_item);
    return std::move(regions_);
  }

  std::string name_of_region(std::int32_t triangle, bool with_values) const {
    const auto row = static_cast<std::size_t>(mesh_.cells[static_cast<std::size_t>(triangle)]);
    std::string name;
    for (const Candidate* const candidate : obeyed_) {
      name.append(candidate == obeyed_.front() ? "" : ", ").append(candidate->text(row, with_values));
    }
    return name;
  }

  const PlanarMesh& mesh_;
  std::vector<Candidate> candidates_;
  InnerEdges edges_;
  Regions regions_;
  std::vector<const Candidate*> obeyed_;
  ValueNumbers numbers_;  ///< the triangles by the values of all obeyed arrays
  const Candidate* constant_ = nullptr;
};

}  // namespace

Regions find_regions(const MeshDocument& document, const PlanarMesh& mesh, std::span<const std::string> names,
                     std::string_view sizes) {
  if (std::ranges::find(names, no_region_arrays) != names.end()) {
    if (names.size() > 1) {
      throw std::invalid_argument("--region-array none switches regions off; it cannot be given with other arrays");
    }
    return {};
  }
  RegionFinder finder(document, mesh);
  return names.empty() ? finder.by_document(sizes) : finder.by_names(names);
}

}  // namespace trismooth
