// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mesh_document.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

void require_count(const std::string& what, std::size_t count, std::size_t expected, std::string_view of) {
  if (count != expected) {
    throw MeshError(what + " has " + std::to_string(count) + " entries, expected one for each of " +
                    std::to_string(expected) + " " + std::string(of));
  }
}

/// `of`: what the numbers are of, "points" or "cells".
void require_rows(std::span<const DataArray> arrays, std::size_t rows, std::string_view of) {
  for (const DataArray& array : arrays) {
    const std::string what = "the array " + trismooth::quoted(array.name);
    require_count(what, array.rows(), rows, of);
    if (array.bytes.size() != rows * array.components * size_of(array.type)) {
      throw MeshError(what + " ends within a number");
    }
  }
}

/// Throws for the first of the numbers that is not below `count`. `what` names them, "the set 'a'".
void require_below(std::span<const std::int32_t> numbers, std::size_t count, const std::string& what,
                   std::string_view of) {
  const auto wrong = std::ranges::find_if(
      numbers, [count](std::int32_t number) { return number < 0 || static_cast<std::size_t>(number) >= count; });
  if (wrong != numbers.end()) {
    throw MeshError(what + " names " + std::string(of) + " " + std::to_string(*wrong) + ", of " +
                    std::to_string(count));
  }
}

void require_sound_points(const MeshDocument& document) {
  if (document.points.size() % 3 != 0) {
    throw MeshError("points: " + std::to_string(document.points.size()) + " numbers, expected 3 for each point");
  }
  const auto bad = std::ranges::find_if_not(document.points, [](double number) { return std::isfinite(number); });
  if (bad != document.points.end()) {
    throw MeshError("vertex " + std::to_string((bad - document.points.begin()) / 3) +
                    " has a coordinate that is not finite");
  }
  check_mesh_size(static_cast<std::int64_t>(document.point_count()), 0);
}

void require_sound_cells(const CellList& cells, std::size_t points) {
  require_count("cells: offsets", cells.offsets.size(), cells.size() + 1, "cells, and one more");
  if (cells.offsets.front() != 0 || cells.offsets.back() != std::ssize(cells.connectivity) ||
      !std::ranges::is_sorted(cells.offsets)) {
    throw MeshError("cells: offsets go from 0 up to the number of entries of connectivity");
  }
  const auto bad = std::ranges::find_if(cells.connectivity, [points](std::int32_t vertex) {
    return vertex < 0 || static_cast<std::size_t>(vertex) >= points;
  });
  if (bad != cells.connectivity.end()) {
    const auto cell = std::ranges::upper_bound(cells.offsets, bad - cells.connectivity.begin());
    throw MeshError("cell " + std::to_string(cell - cells.offsets.begin() - 1) + " names vertex " +
                    std::to_string(*bad) + numbering_text(static_cast<std::int64_t>(points)));
  }
}

}  // namespace

void require_sound(const MeshDocument& document) {
  require_sound_points(document);
  const std::size_t points = document.point_count();
  const std::size_t cells = document.cells.size();
  require_sound_cells(document.cells, points);
  require_rows(document.point_arrays, points, "points");
  require_rows(document.cell_arrays, cells, "cells");
  for (const LabelArray& array : document.cell_labels) {
    const std::string what = "the array " + trismooth::quoted(array.name);
    require_count(what, array.of_row.size(), cells, "cells");
    require_below(array.of_row, array.labels.size(), what, "label");
  }
  for (const std::vector<NamedSet>& sets : {std::cref(document.point_sets), std::cref(document.implied_sets)}) {
    for (const NamedSet& set : sets) {
      require_below(set.members, points, "the set " + trismooth::quoted(set.name), "point");
    }
  }
  for (const NamedSet& set : document.cell_sets) {
    require_below(set.members, cells, "the set " + trismooth::quoted(set.name), "cell");
  }
  for (const auto& pair : document.periodic_pairs) {
    require_below(pair, points, "a periodic pair", "point");
  }
  if (!document.point_labels.empty()) {
    require_count("point_labels", document.point_labels.size(), points, "points");
  }
}

std::vector<std::filesystem::path> OriginalFile::other_files(const std::filesystem::path& /*path*/) const {
  return {};
}

bool OriginalFile::keeps_values_of(std::string_view /*point_array*/) const {
  return false;
}

void OriginalFile::write(const std::filesystem::path& path, const MeshDocument& document,
                         std::span<const DataArray> added_point_arrays,
                         std::span<const DataArray> added_cell_arrays) const {
  Workers alone(1);
  write(path, document, added_point_arrays, added_cell_arrays, alone);
}

}  // namespace trismooth
