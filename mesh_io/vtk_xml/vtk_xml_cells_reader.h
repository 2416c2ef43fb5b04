// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <vtkCellArray.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "trismooth/mesh_io/vtk_xml/vtk_cells.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_decoder.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_pieces.h"

namespace trismooth {

/// Reads the cells of all pieces of a file, joined.
class VtkXmlCellsReader {
 public:
  /// All arguments must outlive the reader. What cannot be kept as it was gives a sentence in `losses`.
  VtkXmlCellsReader(const std::filesystem::path& path, std::span<const VtkXmlPiece> pieces, VtkXmlDecoder& decoder,
                    const FileWorkers& workers, std::vector<std::string>& losses)
      : path_(path), pieces_(pieces), decoder_(decoder), workers_(workers), losses_(losses) {}

  /// The cells in the elements of that name ("Cells", "Polys", ...), of which piece i has counts[i]. Offsets rise,
  /// and every index is one of a point. 32-bit indices where the file has no others. Throws ReadError.
  vtkSmartPointer<vtkCellArray> read_cells(const std::string& section, std::span<const std::uint64_t> counts);

  /// The cells of a group of vtkPolyData: read_cells(), where every cell has as many vertices as the group asks for.
  /// Throws ReadError.
  vtkSmartPointer<vtkCellArray> read_group(PolyDataGroup group, std::span<const std::uint64_t> counts);

  /// The types of the cells in <Cells>; every cell has as many vertices as its type asks for. Throws ReadError.
  vtkSmartPointer<vtkUnsignedCharArray> read_types(vtkCellArray& cells);

 private:
  struct Arrays;

  const XmlElement* array_of(const XmlElement* section, std::string_view name) const;
  Arrays arrays_of(const VtkXmlPiece& piece, const std::string& section) const;

  template <class Index>
  vtkSmartPointer<vtkCellArray> join_cells(const std::string& section, std::span<const std::uint64_t> counts);
  template <class Index>
  void append_integers(const XmlElement& array, std::uint64_t count, MemoryBlock& integers,
                       VtkXmlDecoder::Surplus surplus);

  const std::filesystem::path& path_;
  std::span<const VtkXmlPiece> pieces_;
  VtkXmlDecoder& decoder_;
  FileWorkers workers_;
  std::vector<std::string>& losses_;
};

}  // namespace trismooth
