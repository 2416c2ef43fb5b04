// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/comparison_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "trismooth/base/text/counted.h"
#include "trismooth/pipeline/report/held_text.h"

namespace trismooth {

std::string moved_text(const PipelineResult& result) {
  const ComparisonResult& comparison = *result.comparison;
  if (comparison.moved_vertices == 0) {
    return comparison.rounded_vertices > 0 ? "no vertex, but for rounding" : "no vertex: the coordinates are the same";
  }
  std::string text =
      fmt::format("{} of {}, by {:.3g} at most (vertex {}) and {:.3g} on average", comparison.moved_vertices,
                  counted(result.input.vertices, "vertex", "vertices"), comparison.largest_displacement,
                  comparison.farthest_vertex, comparison.mean_displacement);
  if (comparison.largest_relative_displacement > 0) {
    text += fmt::format("; {:.3g} and {:.3g} of the sides around", comparison.largest_relative_displacement,
                        comparison.mean_relative_displacement);
  }
  return text;
}

std::string moved_held_text(const ComparisonResult& comparison) {
  return held_counts_text(comparison.held);
}

std::string changed_elements_text(const ComparisonResult& comparison) {
  std::string text = fmt::format("{} better, {} worse", comparison.better_elements, comparison.worse_elements);
  if (comparison.newly_invalid_elements > 0) {
    text += fmt::format("; {} inverted or degenerate that {} not", comparison.newly_invalid_elements,
                        comparison.newly_invalid_elements == 1 ? "was" : "were");
  }
  if (comparison.newly_valid_elements > 0) {
    text += fmt::format("; {} inverted or degenerate no more", comparison.newly_valid_elements);
  }
  return text;
}

std::string areas_text(const PipelineResult& result) {
  double change = 0;
  for (const RegionArea& area : result.areas) {
    change = std::max(change, std::abs(area.relative_change()));
  }
  constexpr double rounding = 1e-12;
  return change <= rounding ? std::string("areas are what they were")
                            : fmt::format("areas{} changed by {:.2g} % at most",
                                          result.areas.size() > 1 ? " of regions" : "", 100 * change);
}

}  // namespace trismooth
