// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/document/number_sites.h"

namespace trismooth {

/// One property of a PLY element: a number a row or, with a count_type, a list of numbers a row.
struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::float64;
  std::optional<ScalarType> count_type;
  std::string label;  ///< how messages call it: "property 'x' of element 'vertex'"

  bool is_list() const { return count_type.has_value(); }
};

/// One element of a PLY file: `count` rows of its properties.
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;  ///< names are unique within the element

  /// The position of the property of that name among the properties, or nothing.
  std::optional<std::size_t> find(std::string_view property) const;
};

/// What the header of a PLY file declares.
struct PlyHeader {
  NumberEncoding encoding = NumberEncoding::text;
  std::vector<PlyElement> elements;  ///< in the order of their data; names are unique
  std::size_t size = 0;              ///< bytes of the header: the offset of the first row

  /// The element of that name, or nullptr.
  const PlyElement* find(std::string_view element) const;
};

/// Reads the header at the start of `bytes`, behind a byte-order mark if there is one; lines end with LF, CR LF or CR.
/// Throws ReadError with the line. Declared counts are taken as they are: nothing is checked against the file's size.
PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view bytes);

/// True for the types that PLY has: all but the 64-bit integers, which some programs read and write all the same.
bool is_ply_type(ScalarType type);

/// PLY's own name of one of its types: "char", "uchar", ... "double".
std::string_view ply_type_name(ScalarType type);

}  // namespace trismooth
