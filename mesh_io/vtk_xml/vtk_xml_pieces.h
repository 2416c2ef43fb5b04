// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/vtk_xml/vtk_cells.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// A <Piece> of a file and what it says it holds.
struct VtkXmlPiece {
  const XmlElement* element = nullptr;
  std::uint64_t points = 0;
  std::uint64_t cells = 0;                               ///< all of them
  std::array<std::uint64_t, poly_data_groups> groups{};  ///< of vtkPolyData, by PolyDataGroup
};

/// What is known stands in its parent once: VTK takes one of two and drops the other. Throws ReadError at a second
/// child of that name.
void refuse_second(const std::filesystem::path& path, const XmlElement& parent, std::string_view name);

/// The pieces of a data set element; the element itself where it holds none, as VTK reads it. Refuses time steps and
/// sections that stand there twice. Elements without a meaning here give a sentence in `losses`. Throws ReadError.
std::vector<VtkXmlPiece> find_vtk_xml_pieces(const std::filesystem::path& path, const XmlElement& data_set,
                                             VtkXmlKind kind, std::vector<std::string>& losses);

/// What a <DataArray> or <Array> says of its values.
struct VtkXmlArrayType {
  enum class Values : std::uint8_t { numbers, bits, strings };

  std::string name;
  Values values = Values::numbers;
  ScalarType type = ScalarType::float64;  ///< of numbers
  std::uint64_t components = 1;
  bool ids = false;  ///< VTK's own index type

  bool operator==(const VtkXmlArrayType&) const = default;
};

/// Throws ReadError for a type that is not known, a number of components that makes no sense and for time steps.
VtkXmlArrayType vtk_xml_array_type_of(const std::filesystem::path& path, const XmlElement& array);

/// The arrays among the children of the element, which may be null.
std::vector<const XmlElement*> vtk_xml_arrays_of(const XmlElement* element);

/// The attribute as a whole number, or nothing where it is missing. Throws ReadError where it is no such number.
std::optional<std::uint64_t> whole_number_attribute(const std::filesystem::path& path, const XmlElement& element,
                                                    std::string_view attribute);

}  // namespace trismooth
