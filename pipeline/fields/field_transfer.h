// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/pipeline/fields/mesh_place.h"

namespace trismooth {

class Workers;

/// The value of a field that is linear in the triangle: `corners` has it at the corners. Never outside of their range,
/// and exactly theirs at a corner; a corner of weight 0 has no say, even where it is NaN or infinite.
double interpolated_value(const std::array<double, 3>& corners, const std::array<double, 3>& weights);

/// A point array whose values followed the mesh.
struct TransferredField {
  DataArray array;
  std::int64_t kept_vertices = 0;  ///< those that kept a value for what is missing at their place
  std::string missing;             ///< the values that stand for none, for people: "-99999, nan"; empty: there are none
};

/// The point array, of floating point, with the values of `vertices` (each once) taken from `places` in the array's own
/// triangles, each component alone, rounded to its type; all others keep their bits, as do vertices that are nowhere,
/// and those whose place is in a triangle with a corner that has no value (see MissingValues; one of weight 0 has no
/// say): between a depth and none there is nothing to be had.
/// The same bits for every number of workers. Complexity: linear in the array.
TransferredField interpolated(const DataArray& array, std::span<const Triangle> triangles,
                              std::span<const std::int32_t> vertices, std::span<const MeshPlace> places,
                              Workers& workers);

}  // namespace trismooth
