// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_cells_reader.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkUnsignedCharArray.h>

#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/document/cells/cell_size.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_arrays.h"

namespace trismooth {

namespace {

bool is_integer(ScalarType type) {
  return type != ScalarType::float32 && type != ScalarType::float64;
}

/// vtkUnstructuredGrid keeps more of these cells than indices and a type, or numbers their vertices by the file's
/// version.
bool is_unsupported(std::uint8_t type) {
  return type == VTK_POLYHEDRON || type == VTK_HIGHER_ORDER_HEXAHEDRON || type == VTK_LAGRANGE_HEXAHEDRON ||
         type == VTK_BEZIER_HEXAHEDRON;
}

template <class Index>
std::span<Index> values_from(MemoryBlock& block, std::size_t first) {
  return std::span(reinterpret_cast<Index*>(block.data()), block.size() / sizeof(Index)).subspan(first);
}

/// Adds `shift` to all of them.
template <class Index>
void shift_all(std::span<Index> values, std::uint64_t shift, const FileWorkers& workers) {
  if (shift > 0) {
    for_file_blocks(workers, values.size(), sizeof(Index), [&](std::size_t begin, std::size_t end) {
      for (Index& value : values.subspan(begin, end - begin)) {
        value = static_cast<Index>(value + static_cast<Index>(shift));
      }
    });
  }
}

/// The first cell of a type that is not supported or of another number of vertices than that asks for, or how many
/// there are.
template <class Index>
std::size_t first_of_wrong_size(const Index* offsets, std::span<const std::uint8_t> types, const FileWorkers& workers) {
  return first_wrong(workers, types.size(), sizeof(Index), [offsets, types](std::size_t cell) {
    const auto vertices = static_cast<std::size_t>(offsets[cell + 1] - offsets[cell]);
    return is_unsupported(types[cell]) || !cell_size_of(types[cell]).allows(vertices);
  });
}

}  // namespace

struct VtkXmlCellsReader::Arrays {
  const XmlElement* offsets;
  const XmlElement* connectivity;
};

const XmlElement* VtkXmlCellsReader::array_of(const XmlElement* section, std::string_view name) const {
  const XmlElement* found = nullptr;
  for (const XmlElement* const array : vtk_xml_arrays_of(section)) {
    const VtkXmlArrayType type = vtk_xml_array_type_of(path_, *array);
    if (type.name != name) {
      continue;
    }
    if (type.values != VtkXmlArrayType::Values::numbers || !is_integer(type.type) || type.components != 1) {
      throw ReadError(path_, array->line, "array " + trismooth::quoted(name) + " does not hold one whole number a row");
    }
    if (found != nullptr) {
      throw ReadError(path_, array->line, "a second array " + trismooth::quoted(name) + " in <" + section->name + ">");
    }
    found = array;
  }
  return found;
}

VtkXmlCellsReader::Arrays VtkXmlCellsReader::arrays_of(const VtkXmlPiece& piece, const std::string& section) const {
  const XmlElement* const element = piece.element->child(section);
  if (element == nullptr) {
    throw ReadError(path_, piece.element->line, "<" + piece.element->name + "> has no <" + section + ">");
  }
  const Arrays arrays{array_of(element, "offsets"), array_of(element, "connectivity")};
  if (arrays.offsets == nullptr || arrays.connectivity == nullptr) {
    throw ReadError(
        path_, element->line,
        "<" + section + "> has no array '" + (arrays.offsets == nullptr ? "offsets" : "connectivity") + "'");
  }
  return arrays;
}

template <class Index>
void VtkXmlCellsReader::append_integers(const XmlElement& array, std::uint64_t count, MemoryBlock& integers,
                                        VtkXmlDecoder::Surplus surplus) {
  const ScalarType type = vtk_xml_array_type_of(path_, array).type;
  visit_scalar_type(type, [&](auto zero) {
    using Stored = decltype(zero);
    if constexpr (std::is_same_v<Stored, Index>) {
      decoder_.read_numbers(array, type, count, integers, surplus);
    } else if constexpr (std::is_integral_v<Stored>) {
      MemoryBlock stored;
      decoder_.read_numbers(array, type, count, stored, surplus);
      integers.reserve_more(count * sizeof(Index));
      for (const Stored value : values_from<Stored>(stored, 0)) {
        if (!std::in_range<Index>(value)) {
          throw ReadError(path_, array.line,
                          "array " + trismooth::quoted(*array.attribute("Name")) + " holds " + std::to_string(value) +
                              ", which is out of range");
        }
        const auto converted = static_cast<Index>(value);  // NOLINT(bugprone-signed-char-misuse): a number
        integers.append(&converted, sizeof(Index));
      }
    }
  });
}

template <class Index>
vtkSmartPointer<vtkCellArray> VtkXmlCellsReader::join_cells(const std::string& section,
                                                            std::span<const std::uint64_t> counts) {
  MemoryBlock offsets;
  MemoryBlock connectivity;
  std::memset(offsets.extend(sizeof(Index)), 0, sizeof(Index));
  std::uint64_t first_point = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (counts[i] > 0) {
      const Arrays arrays = arrays_of(pieces_[i], section);
      const std::size_t first_offset = offsets.size() / sizeof(Index);
      const std::size_t first_index = connectivity.size() / sizeof(Index);
      // Offsets and types behind those of the declared cells would be more cells: a part of the mesh.
      append_integers<Index>(*arrays.offsets, counts[i], offsets, VtkXmlDecoder::Surplus::refused);
      const std::span<Index> ends = values_from<Index>(offsets, first_offset);
      const auto begin_of = [ends](std::size_t cell) { return cell == 0 ? Index{0} : ends[cell - 1]; };
      const std::size_t falling = first_wrong(workers_, ends.size(), sizeof(Index),
                                              [&](std::size_t cell) { return ends[cell] < begin_of(cell); });
      if (falling < ends.size()) {
        throw ReadError(path_, arrays.offsets->line,
                        "the offsets of <" + section + "> fall from " + std::to_string(begin_of(falling)) + " to " +
                            std::to_string(ends[falling]) + " at cell " + std::to_string(falling));
      }
      const std::uint64_t most = std::numeric_limits<Index>::max() - first_index;
      const auto large = std::ranges::find_if(ends, [most](Index end) { return std::cmp_greater(end, most); });
      if (large != ends.end()) {
        throw ReadError(path_, arrays.offsets->line,
                        "the offset " + std::to_string(*large) + " in <" + section + "> is too large");
      }
      append_integers<Index>(*arrays.connectivity, static_cast<std::uint64_t>(ends.back()), connectivity,
                             VtkXmlDecoder::Surplus::noted);
      shift_all(ends, first_index, workers_);
      const std::span<Index> vertices = values_from<Index>(connectivity, first_index);
      // A negative one is higher than any limit.
      const std::size_t wrong = first_wrong(
          workers_, vertices.size(), sizeof(Index), [vertices, limit = pieces_[i].points](std::size_t corner) {
            return static_cast<std::make_unsigned_t<Index>>(vertices[corner]) >= limit;
          });
      if (wrong < vertices.size()) {
        throw ReadError(path_, arrays.connectivity->line,
                        "a cell of <" + section + "> has the point index " + std::to_string(vertices[wrong]) +
                            "; there are " + std::to_string(pieces_[i].points) + " points");
      }
      shift_all(vertices, first_point, workers_);
    }
    first_point += pieces_[i].points;
  }
  constexpr ScalarType type = sizeof(Index) == 4 ? ScalarType::int32 : ScalarType::int64;
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (sizeof(Index) == 4) {
    cells->Use32BitStorage();
  }
  cells->SetData(make_vtk_array(type, 1, std::move(offsets)).Get(),
                 make_vtk_array(type, 1, std::move(connectivity)).Get());
  return cells;
}

vtkSmartPointer<vtkCellArray> VtkXmlCellsReader::read_cells(const std::string& section,
                                                            std::span<const std::uint64_t> counts) {
  bool all_int32 = true;
  bool all_int64 = true;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (counts[i] == 0 && vtk_xml_arrays_of(pieces_[i].element->child(section)).empty()) {
      continue;
    }
    const Arrays arrays = arrays_of(pieces_[i], section);
    if (counts[i] == 0) {
      decoder_.expect_empty(*arrays.connectivity);
    }
    for (const XmlElement* const array : {arrays.offsets, arrays.connectivity}) {
      const ScalarType type = vtk_xml_array_type_of(path_, *array).type;
      all_int32 = all_int32 && type == ScalarType::int32;
      all_int64 = all_int64 && type == ScalarType::int64;
    }
  }
  if (!all_int32 && !all_int64) {
    losses_.push_back("the indices in <" + section + "> are written as Int64");
  }
  return all_int32 && !all_int64 ? join_cells<std::int32_t>(section, counts)
                                 : join_cells<std::int64_t>(section, counts);
}

vtkSmartPointer<vtkCellArray> VtkXmlCellsReader::read_group(PolyDataGroup group,
                                                            std::span<const std::uint64_t> counts) {
  const std::string section(to_string(group));
  vtkSmartPointer<vtkCellArray> cells = read_cells(section, counts);
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
    const auto vertices = static_cast<std::size_t>(cells->GetCellSize(cell));
    const std::uint8_t type = cell_type_of(group, vertices);
    if (!cell_size_of(type).allows(vertices)) {
      throw ReadError(path_,
                      "cell " + std::to_string(cell) + " of <" + section + "> " + describe_wrong_size(type, vertices));
    }
  }
  return cells;
}

vtkSmartPointer<vtkUnsignedCharArray> VtkXmlCellsReader::read_types(vtkCellArray& cells) {
  MemoryBlock types;
  bool all_uint8 = true;
  for (const VtkXmlPiece& piece : pieces_) {
    const XmlElement* const section = piece.element->child("Cells");
    if (piece.cells > 0) {
      const XmlElement* const array = array_of(section, "types");
      if (array == nullptr) {
        throw ReadError(path_, section->line, "<Cells> has no array 'types'");
      }
      all_uint8 = all_uint8 && vtk_xml_array_type_of(path_, *array).type == ScalarType::uint8;
      append_integers<std::uint8_t>(*array, piece.cells, types, VtkXmlDecoder::Surplus::refused);
    }
    for (const XmlElement* const array : vtk_xml_arrays_of(section)) {
      const std::string name = vtk_xml_array_type_of(path_, *array).name;
      if (name != "offsets" && name != "connectivity" && name != "types") {
        losses_.push_back("the array " + trismooth::quoted(name) + " of <Cells> is not kept");
      }
    }
  }
  if (!all_uint8) {
    losses_.emplace_back("the cell types are written as UInt8");
  }
  const std::span<const std::uint8_t> values = values_from<std::uint8_t>(types, 0);
  const std::size_t cell = cells.IsStorage64Bit()
                               ? first_of_wrong_size(cells.GetOffsetsArray64()->GetPointer(0), values, workers_)
                               : first_of_wrong_size(cells.GetOffsetsArray32()->GetPointer(0), values, workers_);
  if (cell < values.size() && is_unsupported(values[cell])) {
    throw ReadError(path_, "cell " + std::to_string(cell) + " has type " + std::to_string(values[cell]) +
                               ", which is not supported");
  }
  if (cell < values.size()) {
    const auto vertices = static_cast<std::size_t>(cells.GetCellSize(static_cast<vtkIdType>(cell)));
    throw ReadError(path_, "cell " + std::to_string(cell) + " " + describe_wrong_size(values[cell], vertices));
  }
  return vtkUnsignedCharArray::SafeDownCast(make_vtk_array(ScalarType::uint8, 1, std::move(types)));
}

}  // namespace trismooth
