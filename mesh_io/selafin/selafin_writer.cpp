// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/selafin/selafin_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/cells/boundary_edges.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/place_values.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/selafin/selafin_names.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::array selafin_types{cell_type::triangle};

/// A component of a point array.
struct Variable {
  const DataArray* array;
  std::size_t component;
  std::string name;
};

struct Variables {
  std::vector<Variable> all;
  PlaceValues bottom;                ///< what "BOTTOM" has, where an array of another name or sign is written so
  std::vector<std::string> renamed;  ///< "'a long name of heat' (as a long name of h)"
  std::vector<std::string> split;    ///< arrays of several components
};

/// A name of 16 characters that no other variable has.
std::string fitted(const std::string& wanted, std::set<std::string>& taken) {
  std::string base = wanted;
  std::ranges::replace_if(
      base, [](char c) { return static_cast<unsigned char>(c) < ' '; }, '_');
  base = base.substr(std::min(base.find_first_not_of(' '), base.size()), selafin_name_size);
  base.erase(base.find_last_not_of(' ') + 1);
  std::string name = base;
  for (std::size_t number = 1; name.empty() || !taken.insert(name).second; ++number) {
    const std::string ending = "_" + std::to_string(number);
    name = base.substr(0, selafin_name_size - ending.size()) + ending;
  }
  return name;
}

Variables variables_of(const MeshDocument& document) {
  Variables variables;
  std::set<std::string> taken;
  const auto has_bottom = [](const DataArray& array) { return is_selafin_place_value(array.name); };
  if (std::ranges::none_of(document.point_arrays, has_bottom)) {
    variables.bottom = find_place_values(document, PlaceValue::elevation);
    taken.insert(std::string(selafin_bottom));
  }
  for (const DataArray& array : document.point_arrays) {
    if (!variables.bottom.array.empty() && array.name == variables.bottom.array) {
      variables.all.push_back({&array, 0, std::string(selafin_bottom)});
      continue;
    }
    for (std::size_t k = 0; k < array.components; ++k) {
      std::string wanted = array.name;
      if (array.components > 1) {
        wanted += array.components <= 3 ? std::string(" ") + static_cast<char>('X' + k) : " " + std::to_string(k + 1);
      }
      variables.all.push_back({&array, k, fitted(wanted, taken)});
      if (variables.all.back().name != wanted) {
        variables.renamed.push_back(quoted(std::string_view(wanted)) + " (as " + variables.all.back().name + ")");
      }
    }
    if (array.components > 1) {
      variables.split.push_back(array.name);
    }
  }
  return variables;
}

CellList triangles_of(const CellList& cells) {
  CellList triangles;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.types[cell] == cell_type::triangle) {
      triangles.append(cell_type::triangle, cells[cell]);
    }
  }
  return triangles;
}

/// The boundary as rings of points, with the mesh to the left of triangles that turn left.
class BoundaryRings {
 public:
  BoundaryRings(const CellList& triangles, const std::vector<double>& points)
      : edges_(find_boundary_edges(triangles)), is_used_(edges_.size()), points_(points) {
    std::ranges::sort(edges_);
  }

  /// The number of each point along the boundary, from 1; 0: inside. The ring around the largest area is first, and of
  /// each the point of the lowest x + y, as TELEMAC has them.
  std::vector<std::int32_t> number() {
    std::vector<std::vector<std::int32_t>> rings;
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (!is_used_[first]) {
        rings.push_back(ring_from(first));
      }
    }
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      order.emplace_back(-std::abs(area_of(rings[i])), i);
      const auto start =
          std::ranges::min_element(rings[i], {}, [this](std::int32_t point) { return x(point) + y(point); });
      std::rotate(rings[i].begin(), start, rings[i].end());
    }
    std::ranges::sort(order);
    std::vector<std::int32_t> numbers(points_.size() / 3);
    std::int32_t next = 1;
    for (const auto& [area, ring] : order) {
      for (const std::int32_t point : rings[ring]) {
        std::int32_t& number = numbers[static_cast<std::size_t>(point)];
        number = number == 0 ? next++ : number;
      }
    }
    return numbers;
  }

 private:
  std::vector<std::int32_t> ring_from(std::size_t edge) {
    std::vector<std::int32_t> ring;
    while (edge < edges_.size() && !is_used_[edge]) {
      is_used_[edge] = true;
      ring.push_back(edges_[edge][0]);
      const std::int32_t end = edges_[edge][1];
      // The first one that goes on and is left; where rings touch, those before it are used up for good.
      std::size_t& next = next_of_.try_emplace(end, first_from(end)).first->second;
      while (next < edges_.size() && edges_[next][0] == end && is_used_[next]) {
        ++next;
      }
      edge = next < edges_.size() && edges_[next][0] == end ? next : edges_.size();
    }
    return ring;
  }

  std::size_t first_from(std::int32_t point) const {
    const auto found =
        std::ranges::lower_bound(edges_, point, {}, [](const std::array<std::int32_t, 2>& edge) { return edge[0]; });
    return static_cast<std::size_t>(found - edges_.begin());
  }

  double area_of(const std::vector<std::int32_t>& ring) const {
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::int32_t a = ring[i];
      const std::int32_t b = ring[(i + 1) % ring.size()];
      area += (x(a) - x(ring[0])) * (y(b) - y(ring[0])) - (x(b) - x(ring[0])) * (y(a) - y(ring[0]));
    }
    return area;
  }

  double x(std::int32_t point) const { return points_[3 * static_cast<std::size_t>(point)]; }
  double y(std::int32_t point) const { return points_[3 * static_cast<std::size_t>(point) + 1]; }

  std::vector<std::array<std::int32_t, 2>> edges_;
  std::vector<bool> is_used_;
  std::map<std::int32_t, std::size_t> next_of_;  ///< the edge to look at first, of points
  const std::vector<double>& points_;
};

class SelafinWriter {
 public:
  explicit SelafinWriter(const std::filesystem::path& path) : path_(path), file_(path) {}

  void write(const MeshDocument& document) {
    constexpr std::size_t title_size = 72;
    std::string title = "written by trismooth";
    title.resize(title_size, ' ');
    write_record(title + "SERAFIND");
    const Variables variables = variables_of(document);
    write_integers({static_cast<std::int32_t>(variables.all.size()), 0});
    for (const Variable& variable : variables.all) {
      std::string text = variable.name;
      text.resize(selafin_name_size, ' ');
      text += unit_of(*variable.array);
      text.resize(selafin_name_size + selafin_unit_size, ' ');
      write_record(text);
    }
    write_integers({1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const CellList triangles = triangles_of(document.cells);
    const std::size_t points = document.point_count();
    write_integers({static_cast<std::int32_t>(triangles.size()), static_cast<std::int32_t>(points), 3, 1});
    write_numbers<std::int32_t>(triangles.connectivity.size(),
                                [&](std::size_t i) { return triangles.connectivity[i] + 1; });
    write_integers(BoundaryRings(triangles, document.points).number());
    for (std::size_t axis = 0; axis < 2; ++axis) {
      write_numbers<double>(points, [&](std::size_t i) { return document.points[3 * i + axis]; });
    }
    if (!variables.all.empty()) {
      write_numbers<double>(1, [](std::size_t /*i*/) { return 0.0; });
    }
    for (const Variable& variable : variables.all) {
      const bool is_bottom = variable.array->name == variables.bottom.array && variable.name == selafin_bottom;
      write_numbers<double>(points, [&](std::size_t i) {
        return is_bottom ? variables.bottom.values[i] : variable.array->value(i, variable.component);
      });
    }
    file_.close();
  }

 private:
  template <class T>
  void put(T number) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(in_byte_order<std::endian::big>(number));
    file_.write({bytes.data(), bytes.size()});
  }

  void put_size(std::size_t size) {
    if (size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw WriteError(path_, "the mesh is too large for SELAFIN, whose lists have 2 GiB at most");
    }
    put(static_cast<std::int32_t>(size));
  }

  void write_record(std::string_view bytes) {
    put_size(bytes.size());
    file_.write(bytes);
    put_size(bytes.size());
  }

  template <class T, class Number>
  void write_numbers(std::size_t count, const Number& number) {
    put_size(count * sizeof(T));
    for (std::size_t i = 0; i < count; ++i) {
      put<T>(number(i));
    }
    put_size(count * sizeof(T));
  }

  void write_integers(const std::vector<std::int32_t>& numbers) {
    write_numbers<std::int32_t>(numbers.size(), [&numbers](std::size_t i) { return numbers[i]; });
  }

  const std::filesystem::path& path_;
  BufferedWriter file_;
};

}  // namespace

void write_selafin(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& /*workers*/) {
  require_flat_points(path, "SELAFIN", document);
  SelafinWriter(path).write(document);
}

std::vector<std::string> lost_in_selafin(const MeshDocument& document) {
  std::vector<std::string> sentences = describe_lost_cells("SELAFIN", "triangles", selafin_types, document.cells);
  MeshDocument others;
  others.cell_arrays = document.cell_arrays;
  others.field_arrays = document.field_arrays;
  std::ranges::move(describe_lost_arrays("SELAFIN", others), std::back_inserter(sentences));
  std::ranges::move(describe_lost_sets("SELAFIN", document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_z("SELAFIN", document), std::back_inserter(sentences));
  const Variables variables = variables_of(document);
  if (!variables.bottom.array.empty()) {
    sentences.push_back("SELAFIN has the elevation of the bottom: " + variables.bottom.array + " is written as " +
                        std::string(selafin_bottom));
  }
  if (!variables.split.empty()) {
    sentences.push_back("SELAFIN has one number for a node: the components of " + list_text(variables.split) +
                        " are variables of their own");
  }
  if (!variables.renamed.empty()) {
    sentences.push_back("SELAFIN has names of variables of " + std::to_string(selafin_name_size) +
                        " characters at most: changed are " + list_text(variables.renamed));
  }
  std::string whole;
  std::vector<const DataArray*> rounded;
  for (const DataArray& array : document.point_arrays) {
    if (array.type != ScalarType::float32 && array.type != ScalarType::float64) {
      add_to_list(whole, shown_name(array));
      rounded.push_back(&array);
    }
  }
  if (!whole.empty()) {
    sentences.push_back("SELAFIN has real numbers at nodes: the whole ones of " + whole + " are written as such");
  }
  std::ranges::move(describe_rounded("SELAFIN", "real numbers", rounded), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
