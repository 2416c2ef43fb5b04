// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_cells.h"

#include <algorithm>
#include <limits>
#include <string>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/cells/cell_size.h"

namespace trismooth {

namespace {

/// How the integers of a section are stored where it does not say it.
constexpr ScalarType default_integer = ScalarType::int32;

class CellsReader {
 public:
  CellsReader(VtkLegacyInput& input, std::string_view section, std::size_t point_count)
      : input_(input), section_(section), point_count_(static_cast<std::int64_t>(point_count)) {}

  CellList read() {
    const std::uint64_t first = input_.next_count("the number of cells");
    const std::uint64_t second = input_.next_count("the number of integers in " + std::string(section_));
    if (first == 0 && second == 0) {
      return {};
    }
    // No cell of the old form can be mistaken for this word: it would have 1.3e9 vertices.
    if (input_.is_next("offsets")) {
      read_offsets(first, second);
      read_connectivity(second);
    } else {
      read_counted_cells(first, second);
    }
    return std::move(cells_);
  }

 private:
  void read_counted_cells(std::uint64_t cell_count, std::uint64_t size) {
    if (cell_count > size) {
      input_.fail(std::string(section_) + " declares " + std::to_string(cell_count) + " cells in " +
                  std::to_string(size) + " integers");
    }
    input_.begin_values(size, size_of(default_integer), "integers in " + std::string(section_));
    shared_resize(cells_.connectivity, size - cell_count, cells_.offsets, cell_count + 1, input_.workers());
    // Where cells may be of one size each; plain ones are.
    const std::uint64_t columns = cell_count > 0 && size % cell_count == 0 ? size / cell_count : 0;
    const auto read_cells = [&]<class Numbers>(Numbers& numbers, std::size_t first, std::size_t last) {
      std::uint64_t corner = first == 0 ? 0 : first * (columns - 1);
      for (std::uint64_t cell = first; cell < last; ++cell) {
        std::int64_t degree = 0;
        if (!numbers.next(degree, "the number of a cell's vertices")) {
          return false;
        }
        const std::int64_t left = static_cast<std::int64_t>(size - corner - cell) - 1;
        if (degree < 0 || degree > left || (Numbers::is_plain && static_cast<std::uint64_t>(degree) + 1 != columns)) {
          return numbers.fail([&](std::string_view /*number*/) {
            return name_of(cell) + " has " + std::to_string(degree) + " vertices, but of the size declared (" +
                   std::to_string(size) + ") only " + std::to_string(left) + " is left";
          });
        }
        const std::uint64_t end = corner + static_cast<std::uint64_t>(degree);
        if (!Numbers::is_plain && end > cells_.connectivity.size()) {
          cells_.connectivity.resize(end);  // of a size that is wrong, which cells behind this one show
        }
        if (!read_vertices(numbers, corner, end, [cell](std::size_t) { return cell; })) {
          return false;
        }
        corner = end;
        cells_.offsets[cell + 1] = static_cast<std::int64_t>(corner);
      }
      return true;
    };
    input_.read_rows(cell_count, columns, read_cells, default_integer);
    const std::uint64_t taken = cell_count + static_cast<std::uint64_t>(cells_.offsets.back());
    if (taken != size) {
      input_.fail(std::string(section_) + " declares a size of " + std::to_string(size) + ", but its " +
                  std::to_string(cell_count) + " cells take " + std::to_string(taken));
    }
  }

  /// Vertices first to last - 1 of all cells, with room for them; cell_of(i) is the cell of vertex i.
  template <class Numbers, class CellOf>
  bool read_vertices(Numbers& numbers, std::size_t first, std::size_t last, const CellOf& cell_of) {
    for (std::size_t i = first; i < last; ++i) {
      std::int64_t vertex = 0;
      if (!numbers.next(vertex, "a vertex of a cell")) {
        return false;
      }
      if (vertex < 0 || vertex >= point_count_) {
        return numbers.fail([&](std::string_view /*number*/) {
          return name_of(cell_of(i)) + " has vertex " + std::to_string(vertex) + ", but the file has " +
                 std::to_string(point_count_) + " points";
        });
      }
      cells_.connectivity[i] = static_cast<std::int32_t>(vertex);
    }
    return true;
  }

  void read_offsets(std::uint64_t offset_count, std::uint64_t connectivity_count) {
    input_.expect_keyword("offsets");
    const ScalarType type = next_integer_type();
    input_.begin_values(offset_count, size_of(type), "offsets");
    cells_.offsets.assign(offset_count, 0);
    std::int64_t previous = 0;
    const auto read = [&](auto& numbers, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        std::int64_t& offset = cells_.offsets[i];
        if (!numbers.next(offset, "an offset")) {
          return false;
        }
        if (i == 0 ? offset != 0 : offset < previous) {
          return numbers.fail([&](std::string_view /*number*/) {
            return "offset " + std::to_string(i) + " of " + std::string(section_) + " is " + std::to_string(offset) +
                   "; expected " + (i == 0 ? "" : "at least ") + std::to_string(previous);
          });
        }
        previous = offset;
      }
      return true;
    };
    input_.read_rows(offset_count, 0, read, type);  // not in parts: each is compared with the one before
    if (previous != static_cast<std::int64_t>(connectivity_count) || offset_count == 0) {
      input_.fail("the offsets of " + std::string(section_) + " end at " + std::to_string(previous) + ", but " +
                  std::to_string(connectivity_count) + " vertices are declared");
    }
    input_.read_metadata(1);
  }

  void read_connectivity(std::uint64_t connectivity_count) {
    input_.expect_keyword("connectivity");
    const ScalarType type = next_integer_type();
    input_.begin_values(connectivity_count, size_of(type), "vertices of cells");
    shared_resize(cells_.connectivity, connectivity_count, input_.workers());
    const auto cell_of = [this](std::size_t i) {
      return static_cast<std::uint64_t>(std::ranges::upper_bound(cells_.offsets, static_cast<std::int64_t>(i)) -
                                        cells_.offsets.begin() - 1);
    };
    const auto read = [&](auto& numbers, std::size_t first, std::size_t last) {
      return read_vertices(numbers, first, last, cell_of);
    };
    input_.read_rows(connectivity_count, 1, read, type);
    input_.read_metadata(1);
  }

  ScalarType next_integer_type() {
    const VtkLegacyType type = input_.next_type();
    if (type.kind != VtkLegacyType::Kind::numbers || type.scalar == ScalarType::float32 ||
        type.scalar == ScalarType::float64) {
      input_.fail("expected a type of integers (vtktypeint64, ...) in " + std::string(section_));
    }
    return type.scalar;
  }

  std::string name_of(std::uint64_t cell) const {
    return "cell " + std::to_string(cell) + " of " + std::string(section_);
  }

  VtkLegacyInput& input_;
  std::string_view section_;
  std::int64_t point_count_;
  CellList cells_;
};

}  // namespace

CellList read_vtk_legacy_cells(VtkLegacyInput& input, std::string_view section, std::size_t point_count) {
  return CellsReader(input, section, point_count).read();
}

void read_vtk_legacy_cell_types(VtkLegacyInput& input, CellList& cells) {
  constexpr std::int64_t polyhedron = 42;
  const std::size_t cell_count = cells.offsets.size() - 1;
  const std::uint64_t type_count = input.next_count("the number of cell types");
  if (type_count != cell_count) {
    input.fail("declares " + std::to_string(type_count) + " cell types for " + std::to_string(cell_count) + " cells");
  }
  input.begin_values(type_count, size_of(default_integer), "cell types");
  shared_resize(cells.types, cell_count, input.workers());
  const auto read_types = [&cells](auto& numbers, std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell) {
      std::int64_t type = 0;
      if (!numbers.next(type, "a cell type")) {
        return false;
      }
      const auto name = [cell] { return "cell " + std::to_string(cell); };
      if (type < 0 || type > std::numeric_limits<std::uint8_t>::max()) {
        return numbers.fail([&](std::string_view /*number*/) {
          return name() + " has the type " + std::to_string(type) + "; expected 0 to 255";
        });
      }
      if (type == polyhedron) {
        // Its entry in CELLS lists faces, not vertices.
        return numbers.fail(
            [&](std::string_view /*number*/) { return name() + " is a polyhedron (type 42), which is not supported"; });
      }
      cells.types[cell] = static_cast<std::uint8_t>(type);
      if (const std::size_t size = cells[cell].size(); !cell_size_of(cells.types[cell]).allows(size)) {
        return numbers.fail(
            [&](std::string_view /*number*/) { return name() + " " + describe_wrong_size(cells.types[cell], size); });
      }
    }
    return true;
  };
  input.read_rows(cell_count, 1, read_types, default_integer);
}

}  // namespace trismooth
