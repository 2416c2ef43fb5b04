// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_topology.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

const XdmfCellType* cell_type_named(const std::string& word) {
  const auto* const found = std::ranges::find_if(xdmf_cell_types, [&word](const XdmfCellType& type) {
    return xdmf_word(type.names[0]) == word || (!type.names[1].empty() && xdmf_word(type.names[1]) == word);
  });
  return found == xdmf_cell_types.end() ? nullptr : found;
}

/// VTK's type of a cell of that kind with so many vertices.
std::uint8_t type_of(const XdmfCellType& type, std::size_t vertices) {
  if (type.vertices > 0) {
    return type.type;
  }
  if (type.type == cell_type::polygon) {
    return cell_type::of_face(vertices);
  }
  if (type.type == cell_type::line) {
    return vertices == 2 ? cell_type::line : cell_type::poly_line;
  }
  return vertices == 1 ? cell_type::vertex : cell_type::poly_vertex;
}

std::size_t least_vertices(const XdmfCellType& type) {
  return type.type == cell_type::polygon ? 3 : type.type == cell_type::line ? 2 : 1;
}

/// Reads the numbers of a topology as cells.
class CellReader {
 public:
  CellReader(XdmfItems& items, const XmlElement& topology, std::size_t points)
      : items_(items),
        topology_(topology),
        points_(static_cast<std::int64_t>(points)),
        base_(number_in("BaseOffset").value_or(0)) {}

  template <class T>
  CellList uniform(const XdmfCellType& type, std::span<const T> numbers) {
    std::size_t vertices = type.vertices;
    if (vertices == 0) {
      const auto each = number_in("NodesPerElement");
      vertices = static_cast<std::size_t>(each.value_or(static_cast<std::int64_t>(least_vertices(type))));
      if (vertices < least_vertices(type) || (!each && type.type == cell_type::polygon)) {
        fail("NodesPerElement is not the number of vertices of a " + std::string(type.names[0]));
      }
    }
    if (numbers.size() % vertices != 0) {
      fail(std::to_string(numbers.size()) + " numbers are no cells of " + std::to_string(vertices) + " vertices each");
    }
    CellList cells;
    const std::size_t count = numbers.size() / vertices;
    cells.types.assign(count, type_of(type, vertices));
    cells.offsets.resize(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
      cells.offsets[i] = static_cast<std::int64_t>(i * vertices);
    }
    cells.connectivity.resize(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      cells.connectivity[i] = vertex(numbers[i]);
    }
    return cells;
  }

  template <class T>
  CellList mixed(std::span<const T> numbers) {
    CellList cells;
    std::vector<std::int32_t> vertices;
    while (!numbers.empty()) {
      const auto number = static_cast<std::int64_t>(numbers.front());
      numbers = numbers.subspan(1);
      const auto* const type = std::ranges::find(xdmf_cell_types, number, &XdmfCellType::number);
      if (type == xdmf_cell_types.end()) {
        fail("cell " + std::to_string(cells.size()) + " is of the type " + std::to_string(number) +
             ", which is not read");
      }
      std::size_t count = type->vertices;
      if (count == 0) {
        count = numbers.empty() || numbers.front() < 0 ? 0 : static_cast<std::size_t>(numbers.front());
        numbers = numbers.subspan(numbers.empty() ? 0 : 1);
      }
      if (count < least_vertices(*type) || count > numbers.size()) {
        fail("cell " + std::to_string(cells.size()) + " has " + std::to_string(count) + " vertices, and " +
             std::to_string(numbers.size()) + " numbers are left");
      }
      vertices.resize(count);
      std::ranges::transform(numbers.first(count), vertices.begin(), [this](T index) { return vertex(index); });
      numbers = numbers.subspan(count);
      cells.append(type_of(*type, count), vertices);
    }
    return cells;
  }

  void require_count(std::size_t cells) const {
    // XDMF 2 has rows of them as well.
    for (const char* const name : {"NumberOfElements", "Dimensions"}) {
      if (topology_.attribute(name) == nullptr) {
        continue;
      }
      if (number_in(name) != static_cast<std::int64_t>(cells)) {
        fail(std::string(name) + "=" + quoted(std::string_view(*topology_.attribute(name))) + ", but there are " +
             std::to_string(cells) + " cells");
      }
      return;
    }
  }

  [[noreturn]] void fail(const std::string& message) const { items_.fail(topology_.line, message); }

 private:
  std::optional<std::int64_t> number_in(std::string_view name) const {
    const std::string text = xdmf_attribute(topology_, name);
    const std::optional<std::int64_t> number = parse_integer(text);
    if (!text.empty() && !number) {
      fail(std::string(name) + "=" + quoted(std::string_view(text)) + " is no whole number");
    }
    return number;
  }

  template <class T>
  std::int32_t vertex(T index) const {
    const std::int64_t at = static_cast<std::int64_t>(index) - base_;
    if (at < 0 || at >= points_) {
      fail("a cell has the vertex " + std::to_string(index) + ", and there are " + std::to_string(points_) + " points");
    }
    return static_cast<std::int32_t>(at);
  }

  XdmfItems& items_;
  const XmlElement& topology_;
  std::int64_t points_;
  std::int64_t base_;
};

template <class T>
CellList read_cells(XdmfItems& items, CellReader& reader, const XdmfItem& item, const XdmfCellType* type) {
  const std::vector<T> numbers = items.read<T>(item);
  return type == nullptr ? reader.mixed(std::span<const T>(numbers))
                         : reader.uniform(*type, std::span<const T>(numbers));
}

}  // namespace

const XdmfCellType* xdmf_cell_type(std::uint8_t type) {
  const auto* const found = std::ranges::find_if(xdmf_cell_types, [type](const XdmfCellType& one) {
    return one.type == type || (one.vertices == 0 && (type == type_of(one, 5) || type == type_of(one, 1)));
  });
  return found == xdmf_cell_types.end() ? nullptr : found;
}

CellList read_xdmf_cells(XdmfItems& items, const XmlElement& topology, std::size_t points) {
  CellReader reader(items, topology, points);
  const std::string name = xdmf_attribute(topology, "TopologyType", "Type");
  const std::string word = xdmf_word(name);
  if (word == "NOTOPOLOGY") {
    return {};
  }
  const XdmfCellType* const type = cell_type_named(word);
  if (word.find("MESH") != word.npos) {
    reader.fail("the topology " + quoted(std::string_view(name)) +
                " is a structured grid, which is not read: ParaView's filter 'Append Datasets' makes cells of it");
  }
  if (type == nullptr && word != "MIXED") {
    reader.fail("the topology " + quoted(std::string_view(name)) + " is not read");
  }
  if (topology.attribute("Order") != nullptr) {
    reader.fail("the vertices of cells are in an order of their own, which is not read");
  }
  const XdmfItem item = items.only_item_of(topology);
  CellList cells = item.type == ScalarType::int32 && item.place == XdmfItem::Place::hdf5
                       ? read_cells<std::int32_t>(items, reader, item, type)
                       : read_cells<std::int64_t>(items, reader, item, type);
  reader.require_count(cells.size());
  return cells;
}

}  // namespace trismooth
