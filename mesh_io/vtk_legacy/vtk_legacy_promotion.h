// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_layout.h"

namespace trismooth {

/// True where the type that the file has for its coordinates holds every number of `points`: for floating point that is
/// taken for granted.
bool holds_coordinates(const VtkLegacyLayout& layout, std::span<const double> points);

/// A legacy VTK file whose coordinates are double.
struct VtkLegacyPromotion {
  std::string bytes;
  NumberSites coordinates;
};

/// The file `bytes`, whose coordinates are of a type of whole numbers, with the word for that type replaced by "double"
/// and, in BINARY files, the numbers by the same numbers of that type. All other bytes stay.
VtkLegacyPromotion promote_coordinates(std::string_view bytes, const VtkLegacyLayout& layout);

}  // namespace trismooth
