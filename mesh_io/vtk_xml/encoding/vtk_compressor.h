// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <vtkDataCompressor.h>
#include <vtkSmartPointer.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"

namespace trismooth {

/// VTK's compressor of that kind; null for none.
vtkSmartPointer<vtkDataCompressor> make_vtk_compressor(VtkXmlCompressor compressor);

/// VTK's compressor of that kind for a writer that goes through `arrays` from front to back, block by block: with the
/// first block it compresses those that follow, on all workers. Gives the bytes that VTK's own does. The arrays and
/// `workers` must outlive it, and the arrays must not change.
vtkSmartPointer<vtkDataCompressor> make_vtk_compressor(VtkXmlCompressor compressor,
                                                       std::vector<std::span<const std::byte>> arrays,
                                                       Workers& workers);

}  // namespace trismooth
