#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_cells.h"

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
    if (read_plain_cells(cell_count, size)) {
      return;
    }
    cells_.offsets.reserve(cell_count + 1);
    cells_.connectivity.reserve(size - cell_count);
    auto left = static_cast<std::int64_t>(size);
    for (std::uint64_t cell = 0; cell < cell_count; ++cell) {
      const std::int64_t degree = input_.next_integer(default_integer, "the number of a cell's vertices");
      --left;
      if (degree < 0 || degree > left) {
        input_.fail(name_of(cell) + " has " + std::to_string(degree) + " vertices, but of the size declared (" +
                    std::to_string(size) + ") only " + std::to_string(left) + " is left");
      }
      left -= degree;
      read_vertices(cell, degree, default_integer);
      cells_.offsets.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
    }
    if (left != 0) {
      input_.fail(std::string(section_) + " declares a size of " + std::to_string(size) + ", but its " +
                  std::to_string(cell_count) + " cells take " + std::to_string(static_cast<std::int64_t>(size) - left));
    }
  }

  /// Cells of one size each.
  bool read_plain_cells(std::uint64_t cell_count, std::uint64_t size) {
    if (input_.is_binary() || cell_count == 0 || size % cell_count != 0) {
      return false;
    }
    const std::uint64_t degree = size / cell_count - 1;
    shared_resize(cells_.connectivity, size - cell_count, cells_.offsets, cell_count + 1, input_.workers());
    const bool plain = input_.read_plain_rows(
        cell_count, degree + 1, [this, degree](PlainNumbers& numbers, std::size_t first, std::size_t last) {
          for (std::size_t cell = first; cell < last; ++cell) {
            std::uint64_t vertices = 0;
            if (!numbers.next(vertices) || vertices != degree ||
                !read_plain_vertices(numbers, degree * cell, degree * (cell + 1))) {
              return false;
            }
            cells_.offsets[cell + 1] = static_cast<std::int64_t>(degree * (cell + 1));
          }
          return true;
        });
    if (!plain) {
      cells_ = {};
    }
    return plain;
  }

  bool read_plain_vertices(PlainNumbers& numbers, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::int32_t& vertex = cells_.connectivity[i];
      if (!numbers.next(vertex) || vertex < 0 || vertex >= point_count_) {
        return false;
      }
    }
    return true;
  }

  void read_offsets(std::uint64_t offset_count, std::uint64_t connectivity_count) {
    input_.expect_keyword("offsets");
    const ScalarType type = next_integer_type();
    input_.begin_values(offset_count, size_of(type), "offsets");
    cells_.offsets.clear();
    cells_.offsets.reserve(offset_count);
    std::int64_t previous = 0;
    for (std::uint64_t i = 0; i < offset_count; ++i) {
      const std::int64_t offset = input_.next_integer(type, "an offset");
      if (i == 0 ? offset != 0 : offset < previous) {
        input_.fail("offset " + std::to_string(i) + " of " + std::string(section_) + " is " + std::to_string(offset) +
                    "; expected " + (i == 0 ? "" : "at least ") + std::to_string(previous));
      }
      cells_.offsets.push_back(offset);
      previous = offset;
    }
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
    if (input_.read_plain_rows(connectivity_count, 1,
                               [this](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                                 return read_plain_vertices(numbers, first, last);
                               })) {
      input_.read_metadata(1);
      return;
    }
    cells_.connectivity.clear();
    for (std::size_t cell = 0; cell + 1 < cells_.offsets.size(); ++cell) {
      read_vertices(cell, cells_.offsets[cell + 1] - cells_.offsets[cell], type);
    }
    input_.read_metadata(1);
  }

  void read_vertices(std::uint64_t cell, std::int64_t degree, ScalarType type) {
    for (std::int64_t i = 0; i < degree; ++i) {
      const std::int64_t vertex = input_.next_integer(type, "a vertex of a cell");
      if (vertex < 0 || vertex >= point_count_) {
        input_.fail(name_of(cell) + " has vertex " + std::to_string(vertex) + ", but the file has " +
                    std::to_string(point_count_) + " points");
      }
      cells_.connectivity.push_back(static_cast<std::int32_t>(vertex));
    }
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
  if (input.read_plain_rows(cell_count, 1, [&cells](PlainNumbers& numbers, std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
          std::uint8_t& type = cells.types[cell];
          if (!numbers.next(type) || type == polyhedron || !cell_size_of(type).allows(cells[cell].size())) {
            return false;
          }
        }
        return true;
      })) {
    return;
  }
  cells.types.clear();
  for (std::size_t cell = 0; cell < cell_count; ++cell) {
    const std::int64_t type = input.next_integer(default_integer, "a cell type");
    if (type < 0 || type > std::numeric_limits<std::uint8_t>::max()) {
      input.fail("cell " + std::to_string(cell) + " has the type " + std::to_string(type) + "; expected 0 to 255");
    }
    if (type == polyhedron) {
      // Its entry in CELLS lists faces, not vertices.
      input.fail("cell " + std::to_string(cell) + " is a polyhedron (type 42), which is not supported");
    }
    cells.types.push_back(static_cast<std::uint8_t>(type));
    if (!cell_size_of(cells.types.back()).allows(cells[cell].size())) {
      input.fail("cell " + std::to_string(cell) + " " + describe_wrong_size(cells.types.back(), cells[cell].size()));
    }
  }
}

}  // namespace trismooth
