// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// What an array of a legacy VTK file holds.
struct VtkLegacyType {
  enum class Kind : std::uint8_t { numbers, bits, strings, variants };

  Kind kind = Kind::numbers;
  ScalarType scalar = ScalarType::float64;  ///< of numbers, as a BINARY file stores them
};

/// The type that `name` (any case) stands for in a legacy VTK file, or nothing. `long` has 8 bytes; `vtkIdType` has 4,
/// the width in which VTK writes it to these files.
std::optional<VtkLegacyType> vtk_legacy_type(std::string_view name);

/// The name under which every version of VTK since 8 reads numbers of `type` with the same width on every system.
std::string_view vtk_legacy_type_name(ScalarType type);

/// The name behind its %-encoded form in the file ("heat%20flux" is "heat flux"); a '%' that starts no code stays.
std::string decode_vtk_name(std::string_view encoded);

/// The %-encoded form of a name: one token, none that VTK would take for a keyword.
std::string encode_vtk_name(std::string_view name);

}  // namespace trismooth
