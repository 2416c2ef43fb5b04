// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// A file of VTK's XML formats in memory: the data set (vtkUnstructuredGrid or vtkPolyData) and how it was encoded.
struct VtkXmlFile {
  VtkXmlKind kind = VtkXmlKind::unstructured_grid;
  vtkSmartPointer<vtkPointSet> data;
  VtkXmlEncoding encoding;
  XmlAttributes attributes;         ///< of <VTKFile>
  std::vector<std::string> losses;  ///< what of the file the data set does not hold, one sentence each
  std::vector<std::string> notes;   ///< what only another file of the same kind can hold
};

/// Reads a file, whose bytes are `bytes`. Every array comes back with its name, type, component names and values, two
/// of the same name too; several pieces are joined as VTK joins them. Checked: the structure, every count against the
/// bytes at hand, cell indices against the points, cells against their type. Not checked: whether points are finite.
/// Points are float32 or float64; whole numbers become float64. Numbers behind those that are asked for and arrays that
/// are not in every piece are left out. Refused: time steps, polyhedra. Throws ReadError; complexity linear in the
/// size.
VtkXmlFile read_vtk_xml(const std::filesystem::path& path, std::string_view bytes, VtkXmlKind kind,
                        const FileWorkers& workers);

}  // namespace trismooth
