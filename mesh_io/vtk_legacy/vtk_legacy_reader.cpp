// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/bytes/exact_integers.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/cells/cell_size.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_attributes.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_cells.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_input.h"

namespace trismooth {

namespace {

/// The sections of a POLYDATA, in the order of its cells.
constexpr std::array<std::string_view, 4> poly_data_sections{"vertices", "lines", "polygons", "triangle_strips"};

/// The type of a cell with `degree` vertices in the section of that index.
std::uint8_t poly_data_cell_type(std::size_t section, std::size_t degree) {
  switch (section) {
    case 0:
      return degree == 1 ? cell_type::vertex : cell_type::poly_vertex;
    case 1:
      return degree == 2 ? cell_type::line : cell_type::poly_line;
    case 2:
      return degree == 3 ? cell_type::triangle : degree == 4 ? cell_type::quad : cell_type::polygon;
    default:
      return cell_type::triangle_strip;
  }
}

/// Moves the cells of `more` to the end of `cells`.
void append_cells(CellList& cells, CellList&& more) {
  if (cells.size() == 0) {
    cells = std::move(more);
    return;
  }
  const std::int64_t shift = cells.offsets.back();
  std::transform(more.offsets.begin() + 1, more.offsets.end(), std::back_inserter(cells.offsets),
                 [shift](std::int64_t offset) { return offset + shift; });
  cells.connectivity.insert(cells.connectivity.end(), more.connectivity.begin(), more.connectivity.end());
  cells.types.insert(cells.types.end(), more.types.begin(), more.types.end());
}

/// Reads the sections before the point and cell data.
class GeometryReader {
 public:
  GeometryReader(VtkLegacyInput& input, MeshDocument& document, VtkLegacyLayout& layout)
      : input_(input), document_(document), layout_(layout) {}

  void read() {
    read_dataset();
    std::string keyword = input_.peek_keyword();
    while (!keyword.empty() && keyword != "point_data" && keyword != "cell_data") {
      read_section(keyword);
      keyword = input_.peek_keyword();
    }
    require("points");
    if (poly_data_) {
      finish_poly_data();
    } else {
      require("cells");
      require("cell_types");
    }
    layout_.cell_count = document_.cells.size();
  }

 private:
  void read_dataset() {
    input_.expect_keyword("dataset");
    const std::string_view dataset = input_.next_token("the type of the dataset");
    const std::string type = lower_case(dataset);
    poly_data_ = type == "polydata";
    if (!poly_data_ && type != "unstructured_grid") {
      input_.fail("dataset type " + trismooth::quoted(dataset) +
                  " is not supported; UNSTRUCTURED_GRID and POLYDATA are");
    }
  }

  void read_section(const std::string& keyword) {
    const std::string token(input_.next_keyword("a keyword"));
    if (keyword == "field") {
      read_vtk_legacy_field(input_, document_);
      return;
    }
    if (has_read(keyword)) {
      input_.fail("a second section " + token);
    }
    const auto section =
        static_cast<std::size_t>(std::ranges::find(poly_data_sections, keyword) - poly_data_sections.begin());
    if (keyword == "points") {
      read_points();
    } else if (poly_data_ && section < poly_data_sections.size()) {
      require("points");
      read_poly_data_cells(section, token);
    } else if (!poly_data_ && keyword == "cells") {
      require("points");
      document_.cells = read_vtk_legacy_cells(input_, token, document_.point_count());
    } else if (!poly_data_ && keyword == "cell_types") {
      require("cells");
      read_vtk_legacy_cell_types(input_, document_.cells);
    } else {
      input_.fail("unknown keyword " + trismooth::quoted(token));
    }
    sections_read_.push_back(keyword);
  }

  void read_points() {
    const std::uint64_t point_count = input_.next_count("the number of points");
    const VtkLegacyType type = input_.next_type();
    if (type.kind != VtkLegacyType::Kind::numbers) {
      input_.fail("coordinates must be numbers (float, double, int, ...)");
    }
    if (point_count > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max())) {
      input_.fail("declares " + std::to_string(point_count) + " points; at most 2147483647 are supported");
    }
    layout_.type_offset = input_.token_offset();
    layout_.type_length = input_.offset() - input_.token_offset();
    NumberSites& sites = layout_.coordinates;
    sites.type = type.scalar;
    sites.encoding = input_.is_binary() ? NumberEncoding::big_endian : NumberEncoding::text;
    visit_scalar_type(type.scalar, [&](auto zero) { read_coordinates<decltype(zero)>(3 * point_count); });
    if (type.scalar == ScalarType::float32 || type.scalar == ScalarType::float64) {
      document_.point_type = type.scalar;
    } else {
      document_.notes.push_back("the coordinates are of type " + std::string(to_string(type.scalar)) +
                                ": where a moved one is no such number, the file that is written says double");
    }
    document_.points_description = input_.read_metadata(3);
  }

  template <class T>
  void read_coordinates(std::uint64_t count) {
    input_.begin_values(count, sizeof(T), "coordinates");
    shared_resize(document_.points, count, layout_.coordinates.offsets, count, input_.workers());
    input_.read_rows(count, 1, [this](auto& numbers, std::size_t first, std::size_t last) {
      bool read = true;
      for (std::size_t i = first; i < last && read; ++i) {
        T value{};
        read = numbers.next(value, "a coordinate");
        const auto coordinate = static_cast<double>(value);
        if constexpr (std::is_floating_point_v<T>) {
          read = read && (std::isfinite(value) || numbers.fail([i](std::string_view /*number*/) {
                   return "a coordinate of point " + std::to_string(i / 3) + " is not a finite number";
                 }));
        } else {
          const bool is_exact = holds_exactly<T>(coordinate) && static_cast<T>(coordinate) == value;
          read = read && (is_exact || numbers.fail([i, value](std::string_view /*number*/) {
                   return "a coordinate of point " + std::to_string(i / 3) + " is " + std::to_string(value) +
                          ", which double precision does not hold";
                 }));
        }
        document_.points[i] = coordinate;
        layout_.coordinates.offsets[i] = numbers.token_offset();
      }
      return read;
    });
  }

  void read_poly_data_cells(std::size_t section, std::string_view token) {
    CellList cells = read_vtk_legacy_cells(input_, token, document_.point_count());
    const std::size_t cell_count = cells.offsets.size() - 1;
    cells.types.reserve(cell_count);
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
      cells.types.push_back(poly_data_cell_type(section, cells[cell].size()));
      if (!cell_size_of(cells.types.back()).allows(cells[cell].size())) {
        input_.fail("cell " + std::to_string(cell) + " of " + std::string(token) + " " +
                    describe_wrong_size(cells.types.back(), cells[cell].size()));
      }
    }
    poly_data_cells_.at(section) = std::move(cells);
  }

  void finish_poly_data() {
    if (std::ranges::none_of(poly_data_sections, [this](std::string_view section) { return has_read(section); })) {
      input_.fail("expected VERTICES, LINES, POLYGONS or TRIANGLE_STRIPS, found none");
    }
    for (CellList& cells : poly_data_cells_) {
      append_cells(document_.cells, std::move(cells));
    }
  }

  bool has_read(std::string_view keyword) const {
    return std::ranges::find(sections_read_, keyword) != sections_read_.end();
  }

  void require(std::string_view keyword) const {
    if (!has_read(keyword)) {
      input_.fail("expected " + upper_case(keyword) + " before this, found none");
    }
  }

  VtkLegacyInput& input_;
  MeshDocument& document_;
  VtkLegacyLayout& layout_;
  bool poly_data_ = false;
  std::vector<std::string> sections_read_;
  std::array<CellList, poly_data_sections.size()> poly_data_cells_;
};

}  // namespace

MeshDocument read_vtk_legacy(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers,
                             VtkLegacyLayout& layout) {
  MeshDocument document;
  document.format = FileFormat::vtk;
  VtkLegacyInput input(bytes, path, workers);
  layout.binary = input.is_binary();
  GeometryReader(input, document, layout).read();
  read_vtk_legacy_attributes(input, document, layout);
  return document;
}

}  // namespace trismooth
