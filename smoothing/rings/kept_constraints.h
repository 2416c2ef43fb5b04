// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/smoothing/constraints.h"

namespace trismooth {

/// Constraints in memory of our own, for who needs them when the caller's arrays have gone.
class KeptConstraints {
 public:
  /// None.
  KeptConstraints() = default;
  /// Complexity: linear.
  explicit KeptConstraints(const Constraints& constraints)
      : fixed_(constraints.fixed.begin(), constraints.fixed.end()),
        other_cells_(constraints.other_cells.begin(), constraints.other_cells.end()),
        fixed_ids_(constraints.fixed_ids.begin(), constraints.fixed_ids.end()),
        regions_(constraints.regions.begin(), constraints.regions.end()),
        slide_(constraints.slide),
        lines_(slide_.lines.begin(), slide_.lines.end()),
        line_tags_(slide_.line_tags.begin(), slide_.line_tags.end()),
        links_(slide_.links.begin(), slide_.links.end()) {}

  /// Holds the vertices as well whose `reasons` have one of these bits of namespace hold; one byte a vertex. Linear.
  void fix(std::span<const std::uint8_t> reasons, std::uint8_t bits) {
    fixed_.resize(reasons.size(), 0);
    for (std::size_t v = 0; v < reasons.size(); ++v) {
      fixed_[v] |= static_cast<std::uint8_t>(reasons[v] & bits);
    }
  }

  /// Valid for as long as this object stays where it is.
  [[nodiscard]] Constraints view() const {
    Constraints view{
        .fixed = fixed_, .fixed_ids = fixed_ids_, .other_cells = other_cells_, .regions = regions_, .slide = slide_};
    view.slide.lines = lines_;
    view.slide.line_tags = line_tags_;
    view.slide.links = links_;
    return view;
  }

 private:
  std::vector<std::uint8_t> fixed_, other_cells_;
  std::vector<std::int32_t> fixed_ids_, regions_;
  Sliding slide_;
  std::vector<std::int32_t> lines_, line_tags_, links_;
};

}  // namespace trismooth
