#pragma once

#include <filesystem>

#include "trismooth/mesh_io/vtk_xml_header.h"

class vtkPointSet;

namespace trismooth {

/// Writes the data set, a vtkUnstructuredGrid or vtkPolyData, to the plain path `path` through VTK's writer, encoded
/// as said. Every number comes back bit for bit: in ascii mode, an array that holds NaN or an infinity is written as
/// base64, as no text of it reads back. Names may hold any character. Ranges that VTK
/// keeps beside numbers are not written. Throws WriteError.
void write_vtk_xml(const std::filesystem::path& path, vtkPointSet& data, const VtkXmlEncoding& encoding);

}  // namespace trismooth
