#pragma once

#include <vtkDataCompressor.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"

namespace trismooth {

/// VTK's compressor of that kind; null for none.
vtkSmartPointer<vtkDataCompressor> make_vtk_compressor(VtkXmlCompressor compressor);

}  // namespace trismooth
