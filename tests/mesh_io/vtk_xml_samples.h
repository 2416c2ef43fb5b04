// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"

namespace vtk_xml_samples {

/// A name in the folder for temporary files that no other test uses; what stands there is removed at the end.
class TemporaryPath {
 public:
  explicit TemporaryPath(const std::string& extension);
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  ~TemporaryPath();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_bytes(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

/// What the arrays of a sample may hold: VTK's own text writer loses the sign of -0, and its reader stops at NaN.
enum class SpecialValues : bool { none, all };

/// A data set with every kind of cell that its class holds in the plane, and with point, cell and field arrays of
/// every type, several component counts, names of components, active attributes, strings and bits.
vtkSmartPointer<vtkPointSet> make_sample(trismooth::VtkXmlKind kind, trismooth::ScalarType point_type,
                                         SpecialValues special);

/// A plain triangle mesh of n x n points.
vtkSmartPointer<vtkPointSet> make_grid(trismooth::VtkXmlKind kind, int n);

/// Writes with VTK's writer, in blocks so small that compressed arrays have several.
void write_with_vtk(vtkPointSet& data, const std::filesystem::path& path, const trismooth::VtkXmlEncoding& encoding);
/// Reads with VTK's reader.
vtkSmartPointer<vtkPointSet> read_with_vtk(const std::filesystem::path& path, trismooth::VtkXmlKind kind);

/// Every difference between two data sets, one a line: points, cells, and all arrays by name, type, components,
/// component names, active attributes and bits. Empty where there is none.
std::string differences(vtkPointSet& a, vtkPointSet& b);

/// Every way to encode a file; under sanitizers one of those with LZMA.
std::vector<trismooth::VtkXmlEncoding> all_encodings();
std::string to_string(const trismooth::VtkXmlEncoding& encoding);

// NOLINTNEXTLINE(modernize-use-string-view): callers add to it
inline std::string extension_of(trismooth::VtkXmlKind kind) {
  return kind == trismooth::VtkXmlKind::unstructured_grid ? ".vtu" : ".vtp";
}

}  // namespace vtk_xml_samples
