// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/flat_points.h"

#include <algorithm>
#include <limits>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr double flatness_of_points = 1e-6;  // of the larger extent, as of meshes that are smoothed

/// The lowest and the highest value of a coordinate.
struct CoordinateRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  /// Half of it, so that it does not overflow.
  double half_extent() const { return low <= high ? high / 2 - low / 2 : 0; }
};

CoordinateRange range_of(const MeshDocument& document, std::size_t component) {
  CoordinateRange range;
  for (std::size_t i = component; i < document.points.size(); i += 3) {
    range.low = std::min(range.low, document.points[i]);
    range.high = std::max(range.high, document.points[i]);
  }
  return range;
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

/// "2.5", or "from 0 to 2.5".
std::string describe_range(const CoordinateRange& range) {
  return range.low == range.high ? number_text(range.low)
                                 : "from " + number_text(range.low) + " to " + number_text(range.high);
}

}  // namespace

void require_flat_points(const std::filesystem::path& path, std::string_view format, const MeshDocument& document) {
  const CoordinateRange z = range_of(document, 2);
  const double extent = std::max(range_of(document, 0).half_extent(), range_of(document, 1).half_extent());
  if (z.half_extent() > flatness_of_points * extent) {
    throw WriteError(path, std::string(format) + " holds x and y only, and the mesh is in no plane of one z: it runs " +
                               describe_range(z) + "; write a format with three coordinates, or turn the mesh first");
  }
}

std::vector<std::string> describe_lost_z(std::string_view format, const MeshDocument& document) {
  const CoordinateRange z = range_of(document, 2);
  if (document.points.empty() || (z.low == 0 && z.high == 0)) {
    return {};
  }
  return {std::string(format) + " holds x and y only: z, " + describe_range(z) + ", is not written"};
}

}  // namespace trismooth
