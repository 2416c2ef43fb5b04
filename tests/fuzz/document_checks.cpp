// SPDX-License-Identifier: BSD-3-Clause
#include "document_checks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "trismooth/mesh_io/document/cells/straight_cells.h"

#include "broken.h"
#include "support/format_sample.h"

namespace fuzz {

using trismooth::CellList;
using trismooth::DataArray;
using trismooth::FileFormat;
using trismooth::MeshDocument;
using trismooth::ScalarType;
namespace cell_type = trismooth::cell_type;

namespace {

void require_rows(const std::vector<DataArray>& arrays, std::size_t rows, const char* kind) {
  for (const DataArray& array : arrays) {
    require(array.components > 0 && array.bytes.size() == rows * array.components * size_of(array.type),
            fmt::format("{} array '{}' has not {} rows of {} components", kind, array.name, rows, array.components));
  }
}

std::uint8_t canonical_type(std::uint8_t type, std::size_t size) {
  if (type == cell_type::polygon && size == 3) {
    return cell_type::triangle;
  }
  if (type == cell_type::polygon && size == 4) {
    return cell_type::quad;
  }
  if (type == cell_type::poly_vertex && size == 1) {
    return cell_type::vertex;
  }
  return type == cell_type::poly_line && size == 2 ? cell_type::line : type;
}

std::string difference_of_cells(const CellList& a, const CellList& b, Comparison comparison) {
  if (a.size() != b.size()) {
    return fmt::format("{} and {} cells", a.size(), b.size());
  }
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (!std::ranges::equal(a[c], b[c])) {
      return fmt::format("cell {} has other vertices", c);
    }
    const bool same_type = comparison == Comparison::exact
                               ? a.types[c] == b.types[c]
                               : canonical_type(a.types[c], a[c].size()) == canonical_type(b.types[c], b[c].size());
    if (!same_type) {
      return fmt::format("cell {} is of type {} and {}", c, a.types[c], b.types[c]);
    }
  }
  return {};
}

/// XML holds characters, not bytes: a name of anything else is written as what comes close to it.
bool is_plain(const std::string& name) {
  return std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; });
}

bool same_name(const std::string& a, const std::string& b, Comparison comparison) {
  return a == b || (comparison == Comparison::converted && (b.starts_with(a + "_") || !is_plain(a)));
}

std::string difference_of_arrays(const std::vector<DataArray>& a, const std::vector<DataArray>& b,
                                 Comparison comparison, const char* kind) {
  if (a.size() != b.size()) {
    return fmt::format("{} and {} {} arrays", a.size(), b.size(), kind);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same_name(a[i].name, b[i].name, comparison)) {
      return fmt::format("{} arrays named '{}' and '{}'", kind, a[i].name, b[i].name);
    }
    if (a[i].type != b[i].type || a[i].components != b[i].components) {
      return fmt::format("{} array '{}' of {} {} and {} {}", kind, a[i].name, a[i].components, to_string(a[i].type),
                         b[i].components, to_string(b[i].type));
    }
    if (!std::ranges::equal(a[i].bytes, b[i].bytes)) {
      return fmt::format("{} array '{}' of other values", kind, a[i].name);
    }
  }
  return {};
}

CellList in_order_of_vertices(const CellList& cells) {
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&cells](std::size_t a, std::size_t b) {
    return std::ranges::lexicographical_compare(cells[a], cells[b]);
  });
  CellList sorted;
  for (const std::size_t cell : order) {
    sorted.append(cells.types[cell], cells[cell]);
  }
  return sorted;
}

}  // namespace

void require_guarantees(const MeshDocument& document) {
  require(document.points.size() % 3 == 0, "a point has not three coordinates");
  require(document.point_type == ScalarType::float64 || document.point_type == ScalarType::float32,
          "points are neither float32 nor float64");
  for (const double coordinate : document.points) {
    require(std::isfinite(coordinate), "a coordinate is not finite");
    require(
        document.point_type == ScalarType::float64 || static_cast<double>(static_cast<float>(coordinate)) == coordinate,
        "a float32 coordinate is not one");
  }
  const CellList& cells = document.cells;
  require(cells.offsets.size() == cells.size() + 1 && cells.offsets.front() == 0 &&
              std::ranges::is_sorted(cells.offsets) &&
              cells.offsets.back() == static_cast<std::int64_t>(cells.connectivity.size()),
          "the offsets of the cells are not those of their vertices");
  for (const std::int32_t vertex : cells.connectivity) {
    require(vertex >= 0 && static_cast<std::size_t>(vertex) < document.point_count(), "an index is out of range");
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    require(cells.types[c] != cell_type::triangle || cells[c].size() == 3, "a triangle has not three vertices");
  }
  require_rows(document.point_arrays, document.point_count(), "point");
  require_rows(document.cell_arrays, cells.size(), "cell");
  for (const DataArray& array : document.field_arrays) {
    require_rows({array}, array.rows(), "field");
  }
}

MeshDocument straightened(const MeshDocument& document, FileFormat format) {
  const auto& groups = accepted_files::sample_of(format).cells;
  const bool holds_curved = groups.empty() || std::ranges::any_of(groups, [](const auto& types) {
                              return std::ranges::find(types, cell_type::quadratic_triangle) != types.end();
                            });
  return !holds_curved && has_curved_cells(document) ? with_straight_cells(document) : document;
}

MeshDocument held_cells(const MeshDocument& document, FileFormat format) {
  const accepted_files::FormatSample& sample = accepted_files::sample_of(format);
  MeshDocument held;
  held.points = document.points;
  for (std::size_t i = 0; sample.written_point != nullptr && i < held.points.size(); i += 3) {
    const auto point = held.points.begin() + static_cast<std::ptrdiff_t>(i);
    std::ranges::copy(sample.written_point({point[0], point[1], point[2]}), point);
  }
  const auto add_cells = [&](const auto& is_in_group) {
    for (std::size_t c = 0; c < document.cells.size(); ++c) {
      const std::uint8_t type = document.cells.types[c];
      if (is_in_group(type) && (sample.holds_cell == nullptr || sample.holds_cell(type, document.cells[c].size()))) {
        held.cells.append(type, document.cells[c]);
      }
    }
  };
  if (sample.cells.empty()) {
    add_cells([](std::uint8_t /*type*/) { return true; });
  }
  for (const std::vector<std::uint8_t>& group : sample.cells) {
    add_cells([&group](std::uint8_t type) { return std::ranges::find(group, type) != group.end(); });
  }
  if (sample.has_own_order) {
    held.cells = in_order_of_vertices(held.cells);
  }
  return held;
}

std::string difference_of_points(const MeshDocument& a, const MeshDocument& b) {
  if (a.points.size() != b.points.size()) {
    return fmt::format("{} and {} points", a.point_count(), b.point_count());
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a.points[i]) != std::bit_cast<std::uint64_t>(b.points[i])) {
      return fmt::format("coordinate {} of point {} is {} and {}", i % 3, i / 3, a.points[i], b.points[i]);
    }
  }
  return {};
}

std::string difference_of_corners(const MeshDocument& a, const MeshDocument& b) {
  const auto corners = [](const MeshDocument& document) {
    std::vector<double> all;
    for (std::size_t c = 0; c < document.cells.size(); ++c) {
      if (document.cells.types[c] == cell_type::triangle) {
        for (const std::int32_t vertex : document.cells[c]) {
          const auto first = document.points.begin() + 3 * std::ptrdiff_t{vertex};
          all.insert(all.end(), first, first + 3);
        }
      }
    }
    return all;
  };
  const std::vector<double> of_a = corners(a);
  const std::vector<double> of_b = corners(b);
  if (of_a.size() != of_b.size()) {
    return fmt::format("{} and {} triangles", of_a.size() / 9, of_b.size() / 9);
  }
  const auto [in_a, in_b] = std::ranges::mismatch(of_a, of_b);
  return in_a == of_a.end() ? "" : fmt::format("corner coordinate {} is {} and {}", in_a - of_a.begin(), *in_a, *in_b);
}

std::string difference(const MeshDocument& a, const MeshDocument& b, Comparison comparison) {
  if (comparison == Comparison::exact && a.point_type != b.point_type) {
    return "points of another type";
  }
  if (comparison == Comparison::exact && !(a.point_sets == b.point_sets && a.cell_sets == b.cell_sets)) {
    return "other sets";
  }
  for (const std::string& found : {difference_of_points(a, b), difference_of_cells(a.cells, b.cells, comparison),
                                   difference_of_arrays(a.point_arrays, b.point_arrays, comparison, "point"),
                                   difference_of_arrays(a.cell_arrays, b.cell_arrays, comparison, "cell"),
                                   difference_of_arrays(a.field_arrays, b.field_arrays, comparison, "field")}) {
    if (!found.empty()) {
      return found;
    }
  }
  return {};
}

}  // namespace fuzz
