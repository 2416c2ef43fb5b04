// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/flat_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nanobind/stl/string.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/repeated_triangles.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/document/array_names.h"
#include "trismooth/pipeline/input/element_cells.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/point_sets.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/input/slide_lines.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/new_array.h"
#include "trismooth/python/text.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

constexpr ArrayOwner mesh_has{"the mesh has", "it has"};

ScalarType scalar_type_of(const HostArray& array) {
  const std::size_t place = array.item_size() == 1 ? 0 : array.item_size() == 2 ? 1 : array.item_size() == 4 ? 2 : 3;
  constexpr std::array is_signed{ScalarType::int8, ScalarType::int16, ScalarType::int32, ScalarType::int64};
  constexpr std::array is_unsigned{ScalarType::uint8, ScalarType::uint16, ScalarType::uint32, ScalarType::uint64};
  if (array.kind() == 'f') {
    return array.item_size() == sizeof(float) ? ScalarType::float32 : ScalarType::float64;
  }
  return array.kind() == 'i' ? is_signed[place] : is_unsigned[place];
}

/// A mesh of another package as a document. Where its points lie makes no difference, and they are not there.
class Document {
 public:
  Document(std::size_t vertex_count, nb::handle types, nb::handle sizes, nb::handle nodes) {
    if (std::cmp_greater(vertex_count, std::numeric_limits<std::int32_t>::max())) {
      raise_value_error("points", std::to_string(vertex_count) + " vertices are more than 32 bits number");
    }
    document_.points.resize(3 * vertex_count);
    const std::vector<std::int32_t> of_types = integers(types, "points", nb::len(types), "cell");
    const std::vector<std::int32_t> of_sizes = integers(sizes, "points", of_types.size(), "cell");
    CellList& cells = document_.cells;
    cells.types.assign(of_types.begin(), of_types.end());
    std::partial_sum(of_sizes.begin(), of_sizes.end(), std::back_inserter(cells.offsets), sum);
    cells.connectivity = integers(nodes, "points", static_cast<std::size_t>(cells.offsets.back()), "node of a cell");
    for (const std::int32_t v : cells.connectivity) {
      if (v < 0 || std::cmp_greater_equal(v, vertex_count)) {
        raise_value_error("points", "a cell names vertex " + std::to_string(v) +
                                        numbering_text(static_cast<std::int64_t>(vertex_count)));
      }
    }
  }

  void add_cell_array(const std::string& name, nb::handle values) {
    if (!PyList_Check(values.ptr())) {
      document_.cell_arrays.push_back(array_of(name, values, document_.cells.size()));
      return;
    }
    std::vector<std::string> texts;
    for (const nb::handle text : values) {
      texts.push_back(bytes_of_text(text));
    }
    require_rows(name, texts.size(), document_.cells.size());
    const std::vector<std::string_view> views(texts.begin(), texts.end());
    document_.cell_labels.push_back(make_label_array(name, views));
  }

  void add_point_array(const std::string& name, nb::handle values) {
    document_.point_arrays.push_back(array_of(name, values, document_.point_count()));
  }

  void add_point_set(const std::string& name, nb::handle points) {
    document_.point_sets.push_back({name, members_of("fixed: point set '" + name + "'", points)});
  }

  void add_implied_set(const std::string& name, nb::handle points) {
    document_.implied_sets.push_back({name, members_of("points: '" + name + "'", points)});
  }

  const MeshDocument& document() const { return document_; }

 private:
  static void require_rows(const std::string& name, std::size_t rows, std::size_t expected) {
    if (rows != expected) {
      raise_value_error(
          "points", "the array '" + name + "' has " + std::to_string(rows) + " rows for " + std::to_string(expected));
    }
  }

  /// Of numbers that lie one behind the other.
  DataArray array_of(const std::string& name, nb::handle values, std::size_t rows) {
    arrays_.push_back(std::make_unique<HostArray>(values, "points: the array '" + name + "'"));
    const HostArray& array = *arrays_.back();
    require_rows(name, array.extent(0), rows);
    std::size_t components = 1;
    for (std::size_t d = 1; d < array.dimensions(); ++d) {
      components *= array.extent(d);
    }
    const std::size_t bytes = array.extent(0) * components * array.item_size();
    return {name, scalar_type_of(array), components, {array.data(), bytes}, nullptr};
  }

  std::vector<std::int32_t> members_of(const std::string& argument, nb::handle points) const {
    std::vector<std::int32_t> members;
    const std::vector<std::uint8_t> flags = vertex_flags(points, argument, document_.point_count());
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (flags[v] != 0) {
        members.push_back(static_cast<std::int32_t>(v));
      }
    }
    return members;
  }

  static std::int64_t sum(std::int64_t before, std::int64_t next) { return before + next; }

  MeshDocument document_;
  std::vector<std::unique_ptr<HostArray>> arrays_;  ///< whose numbers the document views
};

/// The nodes of the elements, row by row, -1 behind those of an element with fewer: three columns where all are
/// triangles, four where quadrilaterals are among them, six of triangles of six nodes alone, and nine of all others.
nb::object nodes_of(const ElementCells& cells) {
  const bool has_six_all = cells.elements.are_triangles() && cells.quadratics.size() == cells.elements.size();
  const std::size_t columns = !cells.quadratics.empty()        ? (has_six_all ? 6 : 9)
                              : cells.elements.are_triangles() ? 3
                                                               : 4;
  std::vector<std::int32_t> nodes;
  nodes.reserve(columns * cells.elements.size());
  auto quadratic = cells.quadratics.begin();
  for (std::size_t e = 0; e < cells.elements.size(); ++e) {
    const auto corners = cells.elements[e];
    nodes.insert(nodes.end(), corners.begin(), corners.end());
    if (quadratic != cells.quadratics.end() && std::cmp_equal(quadratic->element, e)) {
      std::ranges::copy_if(quadratic++->middles, std::back_inserter(nodes),
                           [](std::int32_t v) { return v != no_corner; });
    }
    nodes.resize(columns * (e + 1), no_corner);
  }
  return new_array<std::int32_t, 2>(std::move(nodes), {cells.elements.size(), columns});
}

/// The regions of all `count` elements that are listed, of those of each once. `repeated`: of all.
std::vector<std::int32_t> of_all_listed(std::vector<std::int32_t> regions, std::size_t count,
                                        std::span<const RepeatedTriangle> repeated) {
  if (regions.size() == count || regions.empty()) {
    return regions;
  }
  std::vector<std::int32_t> all(count, -1);
  auto copy = repeated.begin();
  auto kept = regions.begin();
  for (std::size_t t = 0; t < all.size(); ++t) {
    const bool is_copy = copy != repeated.end() && std::cmp_equal(copy->triangle, t);
    all[t] = is_copy ? all[static_cast<std::size_t>((copy++)->first)] : *kept++;
  }
  return all;
}

/// None: what the mesh says; False: none of it.
std::vector<std::string> names_of(nb::handle value, std::string_view none) {
  std::vector<std::string> names;
  if (value.ptr() == Py_False) {
    names.emplace_back(none);
  } else if (!value.is_none()) {
    for (const nb::handle name : value) {
      names.push_back(bytes_of_text(name));
    }
  }
  return names;
}

void unite(std::vector<std::uint8_t>& flags, const std::vector<std::uint8_t>& others) {
  flags.resize(std::max(flags.size(), others.size()), 0);
  for (std::size_t v = 0; v < others.size(); ++v) {
    flags[v] |= others[v];
  }
}

/// What holds vertices beside regions and cells.
class Holds {
 public:
  Holds(const MeshDocument& document, const ElementCells& cells, const Regions& regions, bool slides)
      : document_(document), cells_(cells), regions_(regions), slides_(slides) {}

  std::vector<std::uint8_t> by_mesh(std::vector<std::string>& notes) const {
    std::vector<std::uint8_t> flags = find_fixed_array(document_, std::nullopt).flags;
    const HeldSets sets = held_sets({});
    unite(flags, sets.flags);
    std::string names;
    for (const FilePointSet& set : sets.sets) {
      // (Of what arrays of markers mark the notes tell.)
      if (set.holds && !is_array(set.name)) {
        names += (names.empty() ? "'" : ", '") + set.name + "' (" + counted(set.vertices, "vertex", "vertices") + ")";
      }
    }
    if (!names.empty()) {
      notes.push_back("point sets hold their vertices: " + names + "; --fixed-set none frees them");
    }
    std::ranges::copy(sets.notes, std::back_inserter(notes));
    return flags;
  }

  /// By a point array or a set.
  std::vector<std::uint8_t> by_name(const std::string& name) const {
    if (choose_fixed_array(document_.point_arrays, name) != nullptr) {
      return find_fixed_array(document_, name).flags;
    }
    try {
      return held_sets({&name, 1}).flags;
    } catch (const std::invalid_argument& error) {
      if (name.find('=') != std::string::npos) {
        raise_value_error("fixed", error.what());
      }
    }
    std::string known = document_.point_arrays.empty() ? "" : array_names(document_.point_arrays);
    for (const NamedSet& set : document_.point_sets) {
      known += (known.empty() ? "" : ", ") + set.name;
    }
    raise_value_error("fixed", "the mesh has no point array or point set '" + name +
                                   "' to hold; it has: " + (known.empty() ? "none" : known));
  }

 private:
  HeldSets held_sets(std::span<const std::string> names) const {
    return find_held_sets(document_, cells_.elements, names, regions_.of_triangle, slides_);
  }

  bool is_array(const std::string& name) const { return find_array(document_.point_arrays, name) != nullptr; }

  const MeshDocument& document_;
  const ElementCells& cells_;
  const Regions& regions_;
  bool slides_;
};

nb::object flags_or_none(std::vector<std::uint8_t> flags) {
  const std::size_t count = flags.size();
  return std::ranges::count(flags, 0) == std::ssize(flags) ? nb::none() : new_array<bool, 1>(std::move(flags), {count});
}

nb::object numbers_of(std::vector<std::int32_t> numbers) {
  const std::size_t count = numbers.size();
  return new_array<std::int32_t, 1>(std::move(numbers), {count});
}

/// What trismooth.adapters.flat.FlatMesh has of a mesh, by name.
nb::dict flat_mesh(std::size_t vertex_count, nb::handle types, nb::handle sizes, nb::handle nodes,
                   nb::handle cell_arrays, nb::handle point_arrays, nb::handle point_sets, nb::handle implied_sets,
                   nb::handle regions_object, nb::handle fixed, bool slides) {
  Document given(vertex_count, types, sizes, nodes);
  for (const nb::handle array : cell_arrays) {
    given.add_cell_array(bytes_of_text(array[0]), array[1]);
  }
  for (const nb::handle array : point_arrays) {
    given.add_point_array(bytes_of_text(array[0]), array[1]);
  }
  for (const nb::handle set : point_sets) {
    given.add_point_set(bytes_of_text(set[0]), set[1]);
  }
  for (const nb::handle set : implied_sets) {
    given.add_implied_set(bytes_of_text(set[0]), set[1]);
  }
  const MeshDocument& document = given.document();
  Workers workers(1);
  ElementCells cells = element_cells(document, workers, Quads::smooth);
  if (cells.elements.empty()) {
    raise_value_error("points", "it has no triangles and no quadrilaterals, of corners or with middles of sides");
  }
  nb::dict flat;
  flat["triangles"] = nodes_of(cells);
  flat["cell_of_triangle"] = numbers_of({cells.cells.begin(), cells.cells.end()});
  const std::size_t listed = cells.elements.size();
  const std::vector<RepeatedTriangle> repeated =
      cells.elements.visit([&](const auto& elements) { return find_repeated_triangles(elements, workers); });
  std::vector<std::string> notes = cells.notes;
  // (Who smooths the arrays tells of triangles that are listed again.)
  take_out_copies(cells, workers);
  Regions regions;
  try {
    regions = find_regions(document, cells, names_of(regions_object, no_region_arrays), {}, mesh_has);
  } catch (const std::invalid_argument& error) {
    raise_value_error("regions", error.what());
  }
  std::ranges::copy(regions.notes, std::back_inserter(notes));
  flat["regions"] = regions.arrays.empty() ? nb::object(nb::none())
                                           : numbers_of(of_all_listed(regions.of_triangle, listed, repeated));
  const Holds holds(document, cells, regions, slides);
  std::vector<std::uint8_t> held;
  if (fixed.is_none()) {
    held = holds.by_mesh(notes);
  }
  for (const std::string& name : names_of(fixed, no_sets)) {
    unite(held, name == no_sets ? std::vector<std::uint8_t>() : holds.by_name(name));
  }
  flat["fixed"] = flags_or_none(std::move(held));
  SlideLines lines = slides ? find_slide_lines(document, cells, regions.arrays) : SlideLines{};
  flat["other_cells"] = flags_or_none(std::move(slides ? lines.in_other_cell : cells.in_other_cell));
  const std::size_t line_count = lines.tags.size();
  flat["lines"] = new_array<std::int32_t, 2>(std::move(lines.lines), {line_count, std::size_t{2}});
  flat["line_tags"] = numbers_of(std::move(lines.tags));
  flat["cell_of_line"] = numbers_of(std::move(lines.of_cell));
  flat["notes"] = texts(notes);
  flat["line_notes"] = texts(lines.notes);
  return flat;
}

}  // namespace

void bind_flat_mesh(nb::module_& module) {
  module.def("flat_mesh", &flat_mesh, "vertex_count"_a, "types"_a, "sizes"_a, "nodes"_a, "cell_arrays"_a,
             "point_arrays"_a, "point_sets"_a, "implied_sets"_a, "regions"_a.none(), "fixed"_a.none(), "slides"_a);
}

}  // namespace trismooth::python
