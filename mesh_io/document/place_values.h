// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// What formats of coasts and rivers write beside x and y of a point.
enum class PlaceValue : bool { depth, elevation };

/// The values of a document's points for such a format.
struct PlaceValues {
  std::string array;           ///< that they are from; empty: none, all values are 0
  std::vector<double> values;  ///< one a point
};

/// From the point array "depth" (or "elevation", TELEMAC's "BOTTOM"), else one of the other with the other sign, else
/// the only one of arrays_of_places that has one component. Arrays with numbers that are not finite do not count.
PlaceValues find_place_values(const MeshDocument& document, PlaceValue wanted);

/// The point arrays that a file of that format gets as what it says of places: the depths of ADCIRC, the elevations of
/// 2dm, the bottom of SELAFIN. Empty for other formats.
std::vector<std::string> written_place_arrays(const MeshDocument& document, FileFormat target);

/// The sentence where there are none: "ADCIRC holds depths: 0 is written for all points, ...".
std::vector<std::string> describe_missing_place_values(std::string_view format, const MeshDocument& document,
                                                       PlaceValue wanted);

}  // namespace trismooth
