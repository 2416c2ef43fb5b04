// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/cell_copies.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/repeated_triangles.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/pipeline/input/element_cells.h"

namespace trismooth {

namespace {

/// The middle across from each corner, by ascending corners; -1 where there is none.
using Middles = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Its nodes between corners; the end where it has none.
std::vector<QuadraticElement>::const_iterator quadratic_of(const ElementCells& mesh, std::int32_t element) {
  const auto found = std::ranges::lower_bound(mesh.quadratics, element, {}, &QuadraticElement::element);
  return found != mesh.quadratics.end() && found->element == element ? found : mesh.quadratics.end();
}

Middles middles_of(const ElementCells& mesh, std::int32_t element) {
  const auto found = quadratic_of(mesh, element);
  const bool has_any = found != mesh.quadratics.end();
  const auto corners = mesh.elements[static_cast<std::size_t>(element)];
  Middles middles;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    middles.emplace_back(previous_corner(corners, i), has_any ? found->middles[i] : -1);
  }
  std::ranges::sort(middles);
  return middles;
}

/// Whether the copy has a middle that the element has not.
bool has_other_middles(const Middles& copy, const Middles& first) {
  return !std::ranges::equal(copy, first, [](const auto& a, const auto& b) { return a.second == -1 || a == b; });
}

}  // namespace

std::vector<std::int32_t> leave_out(ElementCells& mesh, std::span<const std::int32_t> left_out) {
  std::vector<std::int32_t> numbers(mesh.elements.size(), -1);
  BulkVector<std::int32_t> cells;
  std::vector<std::size_t> kept;
  auto next = left_out.begin();
  for (std::size_t e = 0; e < numbers.size(); ++e) {
    if (next != left_out.end() && *next == static_cast<std::int32_t>(e)) {
      ++next;
      continue;
    }
    numbers[e] = static_cast<std::int32_t>(kept.size());
    kept.push_back(e);
    cells.push_back(mesh.cells[e]);
  }
  std::vector<QuadraticElement> quadratics;
  for (const QuadraticElement& quadratic : mesh.quadratics) {
    if (const std::int32_t number = numbers[quadratic.element]; number >= 0) {
      quadratics.push_back({number, quadratic.middles});
    }
  }
  mesh.elements.visit([&]<class Corners>(std::span<const Corners> elements) {
    std::vector<Corners> own(kept.size());
    std::ranges::transform(kept, own.begin(), [&](std::size_t e) { return elements[e]; });
    mesh.list(std::move(own));
  });
  mesh.cells = std::move(cells);
  mesh.quadratics = std::move(quadratics);
  return numbers;
}

void hold_as_other_cell(ElementCells& mesh, std::int32_t element) {
  const auto hold = [&mesh](std::span<const std::int32_t> nodes) {
    for (const std::int32_t v : nodes) {
      if (v != no_corner) {
        mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
      }
    }
  };
  hold(mesh.elements[static_cast<std::size_t>(element)]);
  if (const auto found = quadratic_of(mesh, element); found != mesh.quadratics.end()) {
    hold(found->middles);
  }
  ++mesh.other_cells;
}

std::span<const CellCopy> copies_in_cell(std::span<const CellCopy> copies, std::int32_t cell) {
  const auto first = std::ranges::lower_bound(copies, cell, {}, &CellCopy::cell);
  return {first, std::ranges::upper_bound(first, copies.end(), cell, {}, &CellCopy::cell)};
}

void take_out_copies(ElementCells& mesh, Workers& workers) {
  const auto repeated =
      mesh.elements.visit([&](const auto& listed) { return find_repeated_triangles(listed, workers); });
  if (repeated.empty()) {
    return;
  }
  std::int64_t others = 0;
  std::vector<std::int32_t> left_out;
  for (const auto& [triangle, first] : repeated) {
    left_out.push_back(triangle);
    if (has_other_middles(middles_of(mesh, triangle), middles_of(mesh, first))) {
      hold_as_other_cell(mesh, triangle);
      ++others;
    } else {
      mesh.copies.push_back({first, mesh.cells[triangle]});
    }
  }
  const auto [triangle, first] = repeated.front();
  const auto cell_of = [&](std::int32_t t) { return std::to_string(mesh.cells[t]); };
  const std::string kind(kind_of_elements(mesh));
  mesh.notes.push_back(counted(repeated.size(), kind + " is", kind + "s are") + " listed again (the first is cell " +
                       cell_of(triangle) + ", which has the corners of cell " + cell_of(first) +
                       "): " + (repeated.size() == 1 ? "it is" : "each is") +
                       " counted and smoothed once, as it is listed first; the file keeps all");
  if (others > 0) {
    mesh.notes.push_back(std::to_string(others) + " of the " + kind + "s that are listed again " +
                         (others == 1 ? "has" : "have") +
                         " other middles of sides: kept as they are, their vertices held fixed");
  }
  const std::vector<std::int32_t> numbers = leave_out(mesh, left_out);
  for (CellCopy& copy : mesh.copies) {
    copy.element = numbers[copy.element];
  }
}

}  // namespace trismooth
