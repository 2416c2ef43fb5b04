// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/cell_copies.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/repeated_triangles.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/pipeline/input/triangle_cells.h"

namespace trismooth {

namespace {

/// The middle across from each corner, by ascending corners; -1 where there is none.
using Middles = std::array<std::pair<std::int32_t, std::int32_t>, 3>;

Middles middles_of(const TriangleCells& mesh, std::int32_t triangle) {
  const auto found = std::ranges::lower_bound(mesh.quadratics, triangle, {}, &QuadraticTriangle::triangle);
  const bool has_any = found != mesh.quadratics.end() && found->triangle == triangle;
  Middles middles;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t across = (i + 2) % 3;
    middles[i] = {mesh.triangles[triangle][across], has_any ? found->middles[i] : -1};
  }
  std::ranges::sort(middles);
  return middles;
}

/// Whether the copy has a middle that the triangle has not.
bool has_other_middles(const Middles& copy, const Middles& first) {
  return !std::ranges::equal(copy, first, [](const auto& a, const auto& b) { return a.second == -1 || a == b; });
}

void hold_as_other_cell(TriangleCells& mesh, std::int32_t triangle) {
  for (const auto& [corner, middle] : middles_of(mesh, triangle)) {
    for (const std::int32_t v : {corner, middle}) {
      if (v >= 0) {
        mesh.in_other_cell[v] = 1;
      }
    }
  }
  ++mesh.other_cells;
}

}  // namespace

std::vector<std::int32_t> leave_out(TriangleCells& mesh, std::span<const std::int32_t> left_out) {
  std::vector<Triangle> triangles;
  BulkVector<std::int32_t> cells;
  std::vector<QuadraticTriangle> quadratics;
  std::vector<std::int32_t> numbers(mesh.triangles.size(), -1);
  auto next = left_out.begin();
  for (std::size_t t = 0; t < numbers.size(); ++t) {
    if (next != left_out.end() && *next == static_cast<std::int32_t>(t)) {
      ++next;
      continue;
    }
    numbers[t] = static_cast<std::int32_t>(triangles.size());
    triangles.push_back(mesh.triangles[t]);
    cells.push_back(mesh.cells[t]);
  }
  for (const QuadraticTriangle& quadratic : mesh.quadratics) {
    if (const std::int32_t number = numbers[quadratic.triangle]; number >= 0) {
      quadratics.push_back({number, quadratic.middles});
    }
  }
  mesh.triangles_of_cells = std::move(triangles);
  mesh.triangles = mesh.triangles_of_cells;
  mesh.cells = std::move(cells);
  mesh.quadratics = std::move(quadratics);
  return numbers;
}

std::span<const CellCopy> copies_in_cell(std::span<const CellCopy> copies, std::int32_t cell) {
  const auto first = std::ranges::lower_bound(copies, cell, {}, &CellCopy::cell);
  return {first, std::ranges::upper_bound(first, copies.end(), cell, {}, &CellCopy::cell)};
}

void take_out_copies(TriangleCells& mesh, Workers& workers) {
  const auto repeated = find_repeated_triangles(mesh.triangles, workers);
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
  mesh.notes.push_back(counted(repeated.size(), "triangle is", "triangles are") + " listed again (the first is cell " +
                       cell_of(triangle) + ", which has the corners of cell " + cell_of(first) +
                       "): " + (repeated.size() == 1 ? "it is" : "each is") +
                       " counted and smoothed once, as it is listed first; the file keeps all");
  if (others > 0) {
    mesh.notes.push_back(std::to_string(others) + " of the triangles that are listed again " +
                         (others == 1 ? "has" : "have") +
                         " other middles of sides: kept as they are, their vertices held fixed");
  }
  const std::vector<std::int32_t> numbers = leave_out(mesh, left_out);
  for (CellCopy& copy : mesh.copies) {
    copy.triangle = numbers[copy.triangle];
  }
}

}  // namespace trismooth
