// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include <vtkPointSet.h>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// Writes the data set, a vtkUnstructuredGrid or vtkPolyData, to the plain path `path` through VTK's writer, encoded
/// as said, with those attributes of <VTKFile>, which must not contradict the encoding, or VTK's own where there are
/// none. Every number comes back bit for bit: in ascii mode, an array that holds NaN or an infinity is written as
/// base64, as no text of it reads back. Names may hold any character. Ranges that VTK
/// keeps beside numbers are not written. Numbers are encoded and blocks compressed by all `workers`, in the same bytes
/// for every number of them; without any, by this thread. Throws WriteError.
void write_vtk_xml(const std::filesystem::path& path, vtkPointSet& data, const VtkXmlEncoding& encoding,
                   const XmlAttributes& attributes, const FileWorkers& workers);
void write_vtk_xml(const std::filesystem::path& path, vtkPointSet& data, const VtkXmlEncoding& encoding,
                   const XmlAttributes& attributes = {});

}  // namespace trismooth
