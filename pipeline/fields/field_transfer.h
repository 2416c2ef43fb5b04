#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/pipeline/fields/mesh_place.h"

namespace trismooth {

class Workers;

/// The value of a field that is linear in the triangle: `corners` has it at the corners. Never outside of their range,
/// and exactly theirs at a corner; a corner of weight 0 has no say, even where it is NaN or infinite.
double interpolated_value(const std::array<double, 3>& corners, const std::array<double, 3>& weights);

/// The point array, of floating point, with the values of `vertices` (each once) taken from `places` in the array's own
/// triangles, each component alone, rounded to its type; all others keep their bits, as do vertices that are nowhere.
/// The same bits for every number of workers. Complexity: linear in the array.
DataArray interpolated(const DataArray& array, std::span<const Triangle> triangles,
                       std::span<const std::int32_t> vertices, std::span<const MeshPlace> places, Workers& workers);

}  // namespace trismooth
