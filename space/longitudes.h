// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// Longitudes, in degrees, made continuous over the elements of a mesh.
struct UnwrappedLongitudes {
  std::vector<std::int32_t> turns;  ///< of 360 degrees, to be added to each vertex' longitude
  std::vector<std::int32_t> cut;    ///< elements, ascending, in which longitudes are not continuous
};

/// Neighbours along a side differ by 180 degrees at most then. A vertex of the lowest number in its component makes no
/// turn. In a component that goes round the globe nobody does: it is cut where the file's longitudes jump. Complexity:
/// n log n at worst, in practice linear.
UnwrappedLongitudes unwrap_longitudes(std::span<const double> longitudes, const ElementList& elements);

}  // namespace trismooth
