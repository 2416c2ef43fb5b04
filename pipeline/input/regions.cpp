#include "trismooth/pipeline/input/regions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "trismooth/base/shell_words.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/pipeline/input/inner_edges.h"
#include "trismooth/pipeline/input/value_names.h"
#include "trismooth/pipeline/input/value_numbers.h"

namespace trismooth {

namespace {

constexpr double most_edges_of_known_names = 1.0 / 2;
constexpr double most_edges_of_others = 1.0 / 3;

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

bool is_few(std::int32_t values, std::size_t triangles) {
  constexpr std::size_t always_few = 10;
  constexpr std::size_t triangles_a_value = 8;
  return static_cast<std::size_t>(values) <= std::max(always_few, triangles / triangles_a_value);
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
    const std::string& name = candidate.array.name;
    const bool known = is_region_name(name);
    if (candidate.array.components != 1) {
      if (known) {
        regions_.notes.push_back(fmt::format("the cell array '{}' has {} components: it is not taken for regions", name,
                                             candidate.array.components));
      }
      return;
    }
    ValueNumbers numbers = number_values(candidate.array, mesh_.cells);
    if (numbers.count() < 2) {
      if (known && numbers.count() == 1 && constant_ == nullptr) {
        constant_ = &candidate;
      }
    } else if (known) {
      judge_known(candidate, std::move(numbers));
    } else {
      judge_unknown(candidate, std::move(numbers));
    }
  }

  void judge_known(const Candidate& candidate, ValueNumbers numbers) {
    const std::optional<double> edges = edges_above(most_edges_of_known_names, numbers);
    if (!edges) {
      obey(candidate, std::move(numbers), RegionReason::known_name);
      return;
    }
    regions_.notes.push_back(fmt::format(
        "the cell array '{0}' changes across {1:.0f} % of the edges between triangles: it is not taken for regions, "
        "what is between its values may move; --region-array {2} holds it",
        candidate.array.name, 100 * *edges, shell_word(candidate.array.name)));
  }

  void judge_unknown(const Candidate& candidate, ValueNumbers numbers) {
    const std::string& name = candidate.array.name;
    const auto left_out = [&](const std::string& why) {
      regions_.notes.push_back(
          fmt::format("the cell array '{0}' ({1} values) is not taken for regions, {2}: what is between its values may "
                      "move; --region-array {3} holds it",
                      name, numbers.count(), why, shell_word(name)));
    };
    if (const std::optional<double> edges = edges_above(most_edges_of_others, numbers)) {
      if (*edges <= most_edges_of_known_names && !is_bookkeeping_name(name)) {
        left_out(fmt::format("it changes across {:.0f} % of the edges between triangles", 100 * *edges));
      }
    } else if (is_bookkeeping_name(name)) {
      left_out("by its name it is for another purpose");
    } else if (!are_whole(candidate.array, mesh_.cells, numbers)) {
      left_out("it does not hold whole numbers");
    } else if (!is_few(numbers.count(), mesh_.triangles.size())) {
      left_out("its values are many for so few triangles");
    } else {
      const std::int32_t values = numbers.count();
      obey(candidate, std::move(numbers), RegionReason::looks_like_regions);
      regions_.notes.push_back(fmt::format(
          "the cell array '{0}' ({1} values) looks like regions: the {2} vertices between them are held. If "
          "that is right, --region-array {3} says so; if not, --region-array none frees them",
          name, values, regions_.arrays.back().held_vertices, shell_word(name)));
    }
  }

  /// The fraction of the inner edges across which the number changes, where it is above `most`, which is 1/3 or more.
  std::optional<double> edges_above(double most, const ValueNumbers& numbers) {
    // Few vertices have few edges between them: Euler's formula bounds these by three a vertex, and connected triangles
    // have about as many inner edges as triangles, at least. So the edges need not be found where interfaces are thin.
    const auto triangles = static_cast<std::int64_t>(mesh_.triangles.size());
    if (9 * edges_.vertices_between(numbers.of_item) <= triangles) {
      return std::nullopt;
    }
    const double fraction = edges_.fraction_between(numbers.of_item);
    return fraction > most ? std::optional(fraction) : std::nullopt;
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
