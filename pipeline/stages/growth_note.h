// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>

#include "trismooth/base/element_list.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

struct RunState;

/// Notes where the growth bound of the method mean-ratio keeps the worst element that has a free corner from getting
/// better: the smart rule would move that corner, but an element would grow beyond the bound. `before`: the mesh that
/// was read. Nothing for other methods, and where sizes or shapes are asked for. Complexity: linear.
void note_growth_bound(RunState& run, const MeshView& before);

// What that note is made of.

/// Whether there may be one. `before`: of the mesh that was read.
bool may_have_growth_note(const SmoothingOptions& options, const QualityReport& before);

struct WorstFreeElement {
  double quotient = std::numeric_limits<double>::infinity();
  std::int64_t element = -1;  ///< none
};

/// The first element of the smallest shape that has a free corner, of those that count. Complexity: linear.
WorstFreeElement worst_with_free_corner(const MeshView& mesh, std::span<const std::uint8_t> fixed,
                                        const std::function<bool(std::size_t)>& counts);

/// The note, where the bound keeps this free vertex of the worst element, all of whose elements are in the views, from
/// making it better; else nothing. `report`: of the mesh that was read. `quotient`: of that element, which is in that
/// `cell`, and `number` is that of the vertex for people. Complexity: linear.
std::string growth_note(const MeshView& before, const MeshView& now, std::int32_t vertex, const QualityReport& report,
                        double quotient, std::int64_t cell, std::int64_t number);

}  // namespace trismooth
