#include "trismooth/mesh_io/document/format_losses.h"

#include <algorithm>
#include <array>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

/// Adds the sentence for arrays or sets, if there are any.
template <class All>
void describe(std::vector<std::string>& sentences, std::string_view format, std::string_view what, const All& all) {
  if (!all.empty()) {
    sentences.push_back(std::string(format) + " holds no " + std::string(what) + ": " +
                        list_text(all, shown_name<typename All::value_type>) + not_written(all.size()));
  }
}

std::string type_name(std::size_t type) {
  switch (type) {
    case cell_type::vertex:
      return "vertex";
    case cell_type::poly_vertex:
      return "poly_vertex";
    case cell_type::line:
      return "line";
    case cell_type::poly_line:
      return "poly_line";
    case cell_type::triangle:
      return "triangle";
    case cell_type::triangle_strip:
      return "triangle_strip";
    case cell_type::polygon:
      return "polygon";
    case cell_type::quad:
      return "quad";
    case cell_type::tetrahedron:
      return "tetrahedron";
    case cell_type::hexahedron:
      return "hexahedron";
    case cell_type::wedge:
      return "wedge";
    case cell_type::pyramid:
      return "pyramid";
    case cell_type::quadratic_edge:
      return "quadratic_edge";
    case cell_type::quadratic_triangle:
      return "quadratic_triangle";
    case cell_type::quadratic_quad:
      return "quadratic_quad";
    case cell_type::biquadratic_quad:
      return "biquadratic_quad";
    default:
      return std::to_string(type) + " (by VTK's numbers)";
  }
}

}  // namespace

std::vector<std::string> describe_lost_arrays(std::string_view format, const MeshDocument& document) {
  std::vector<std::string> sentences;
  describe(sentences, format, "point arrays", document.point_arrays);
  describe(sentences, format, "cell arrays", document.cell_arrays);
  describe(sentences, format, "field arrays", document.field_arrays);
  return sentences;
}

std::vector<std::string> describe_lost_names(std::string_view format, const MeshDocument& document) {
  std::string arrays;
  for (const DataArray& array : document.cell_arrays) {
    if (array.description != nullptr && !array.description->value_names.empty()) {
      add_to_list(arrays, array.name);
    }
  }
  if (arrays.empty()) {
    return {};
  }
  return {std::string(format) + " holds no names of values: those of " + arrays + " are not written"};
}

std::vector<std::string> describe_lost_sets(std::string_view format, const MeshDocument& document) {
  std::vector<std::string> sentences;
  describe(sentences, format, "sets of points", document.point_sets);
  describe(sentences, format, "sets of cells", document.cell_sets);
  return sentences;
}

std::vector<std::string> describe_new_order(std::string_view format, std::span<const std::uint8_t> written_types,
                                            const CellList& cells) {
  std::array<std::size_t, 256> places{};
  for (std::size_t place = 0; place < written_types.size(); ++place) {
    places[written_types[place]] = place + 1;
  }
  std::size_t last = 0;
  for (const std::uint8_t type : cells.types) {
    const std::size_t place = places[type];
    if (place != 0 && place < last) {
      return {std::string(format) + " lists cells by their type: they are written in another order"};
    }
    last = std::max(last, place);
  }
  return {};
}

std::vector<std::string> describe_lost_cells(std::string_view format, std::string_view holds,
                                             std::span<const std::uint8_t> written_types, const CellList& cells) {
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t type : cells.types) {
    ++counts[type];
  }
  for (const std::uint8_t type : written_types) {
    counts[type] = 0;
  }
  std::string lost;
  std::size_t total = 0;
  for (std::size_t type = 0; type < counts.size(); ++type) {
    if (counts[type] > 0) {
      add_to_list(lost, counted(counts[type], "cell of type ", "cells of type ") + type_name(type));
      total += counts[type];
    }
  }
  if (lost.empty()) {
    return {};
  }
  return {std::string(format) + " holds " + std::string(holds) + " only: " + lost + not_written(total)};
}

}  // namespace trismooth
