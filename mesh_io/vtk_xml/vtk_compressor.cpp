#include "trismooth/mesh_io/vtk_xml/vtk_compressor.h"

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkZLibDataCompressor.h>

namespace trismooth {

vtkSmartPointer<vtkDataCompressor> make_vtk_compressor(VtkXmlCompressor compressor) {
  switch (compressor) {
    case VtkXmlCompressor::none:
      break;
    case VtkXmlCompressor::zlib:
      return vtkSmartPointer<vtkZLibDataCompressor>::New();
    case VtkXmlCompressor::lz4:
      return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    case VtkXmlCompressor::lzma:
      return vtkSmartPointer<vtkLZMADataCompressor>::New();
  }
  return nullptr;
}

}  // namespace trismooth
