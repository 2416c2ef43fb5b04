// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <vtkCellArray.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The four lists of cells that a vtkPolyData has, in the order in which VTK numbers its cells.
enum class PolyDataGroup : std::uint8_t { verts, lines, polys, strips };
inline constexpr std::size_t poly_data_groups = 4;

/// "Verts", "Lines", "Polys", "Strips": the elements of a .vtp file.
std::string_view to_string(PolyDataGroup group);

/// The group that holds cells of that type, or nothing where vtkPolyData has none for them.
std::optional<PolyDataGroup> poly_data_group_of(std::uint8_t type);

/// The cell type that VTK gives a cell of that many vertices in the group.
std::uint8_t cell_type_of(PolyDataGroup group, std::size_t vertices);

/// Appends the cells of a VTK cell array whose indices fit 32 bits; one type a cell, or those of the group.
void append_cells(vtkCellArray& from, std::span<const std::uint8_t> types, const FileWorkers& workers, CellList& cells);
void append_cells(vtkCellArray& from, PolyDataGroup group, const FileWorkers& workers, CellList& cells);

/// The cells of those numbers as a VTK cell array; 32 bits wide where that suffices.
vtkSmartPointer<vtkCellArray> make_vtk_cells(const CellList& cells, std::span<const std::size_t> chosen,
                                             const FileWorkers& workers);

}  // namespace trismooth
