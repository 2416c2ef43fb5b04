// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_cells.h"

#include <algorithm>
#include <array>
#include <limits>

#include <vtkCellArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include "trismooth/mesh_io/bytes/shared_blocks.h"

namespace trismooth {

namespace {

template <class Index>
void append_indices(std::span<const Index> offsets, std::span<const Index> connectivity, const FileWorkers& workers,
                    CellList& cells) {
  const std::size_t base = cells.connectivity.size();
  const std::size_t first_cell = cells.offsets.size();
  shared_resize(cells.offsets, first_cell + offsets.size() - 1, cells.connectivity, base + connectivity.size(),
                workers.workers);
  for_file_blocks(workers, offsets.size() - 1, sizeof(std::int64_t), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      cells.offsets[first_cell + i] = static_cast<std::int64_t>(base) + static_cast<std::int64_t>(offsets[i + 1]);
    }
  });
  for_file_blocks(workers, connectivity.size(), sizeof(std::int32_t), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      cells.connectivity[base + i] = static_cast<std::int32_t>(connectivity[i]);
    }
  });
}

template <class Array>
auto values_of(Array* array) {
  using Value = typename Array::ValueType;
  return std::span<const Value>(array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()));
}

void append_indices(vtkCellArray& from, const FileWorkers& workers, CellList& cells) {
  if (from.GetNumberOfCells() == 0) {
    return;
  }
  if (from.IsStorage64Bit()) {
    append_indices(values_of(from.GetOffsetsArray64()), values_of(from.GetConnectivityArray64()), workers, cells);
  } else {
    append_indices(values_of(from.GetOffsetsArray32()), values_of(from.GetConnectivityArray32()), workers, cells);
  }
}

template <class Array>
vtkSmartPointer<vtkCellArray> make_cells_of(const CellList& cells, std::span<const std::size_t> chosen,
                                            std::size_t length, const FileWorkers& workers) {
  using Index = typename Array::ValueType;
  const auto offsets = vtkSmartPointer<Array>::New();
  const auto connectivity = vtkSmartPointer<Array>::New();
  offsets->SetNumberOfValues(static_cast<vtkIdType>(chosen.size()) + 1);
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(length));
  Index* const begins = offsets->GetPointer(0);
  begins[0] = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    begins[i + 1] = begins[i] + static_cast<Index>(cells[chosen[i]].size());
  }
  Index* const vertices = connectivity->GetPointer(0);
  for_file_blocks(workers, chosen.size(), 3 * sizeof(Index), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::ranges::copy(cells[chosen[i]], vertices + begins[i]);
    }
  });
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(offsets, connectivity);
  return result;
}

}  // namespace

std::string_view to_string(PolyDataGroup group) {
  constexpr std::array<std::string_view, poly_data_groups> names{"Verts", "Lines", "Polys", "Strips"};
  return names[static_cast<std::size_t>(group)];
}

std::optional<PolyDataGroup> poly_data_group_of(std::uint8_t type) {
  switch (type) {
    case cell_type::vertex:
    case cell_type::poly_vertex:
      return PolyDataGroup::verts;
    case cell_type::line:
    case cell_type::poly_line:
      return PolyDataGroup::lines;
    case cell_type::triangle:
    case cell_type::quad:
    case cell_type::polygon:
      return PolyDataGroup::polys;
    case cell_type::triangle_strip:
      return PolyDataGroup::strips;
    default:
      return std::nullopt;
  }
}

std::uint8_t cell_type_of(PolyDataGroup group, std::size_t vertices) {
  switch (group) {
    case PolyDataGroup::verts:
      return vertices == 1 ? cell_type::vertex : cell_type::poly_vertex;
    case PolyDataGroup::lines:
      return vertices == 2 ? cell_type::line : cell_type::poly_line;
    case PolyDataGroup::polys:
      break;
    case PolyDataGroup::strips:
      return cell_type::triangle_strip;
  }
  return vertices == 3 ? cell_type::triangle : vertices == 4 ? cell_type::quad : cell_type::polygon;
}

void append_cells(vtkCellArray& from, std::span<const std::uint8_t> types, const FileWorkers& workers,
                  CellList& cells) {
  append_indices(from, workers, cells);
  cells.types.insert(cells.types.end(), types.begin(), types.end());
}

void append_cells(vtkCellArray& from, PolyDataGroup group, const FileWorkers& workers, CellList& cells) {
  const std::size_t first = cells.size();
  append_indices(from, workers, cells);
  cells.types.reserve(cells.offsets.size() - 1);
  for (std::size_t cell = first; cell + 1 < cells.offsets.size(); ++cell) {
    cells.types.push_back(cell_type_of(group, static_cast<std::size_t>(cells.offsets[cell + 1] - cells.offsets[cell])));
  }
}

vtkSmartPointer<vtkCellArray> make_vtk_cells(const CellList& cells, std::span<const std::size_t> chosen,
                                             const FileWorkers& workers) {
  std::size_t length = 0;
  for (const std::size_t cell : chosen) {
    length += cells[cell].size();
  }
  return length <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())
             ? make_cells_of<vtkTypeInt32Array>(cells, chosen, length, workers)
             : make_cells_of<vtkTypeInt64Array>(cells, chosen, length, workers);
}

}  // namespace trismooth
