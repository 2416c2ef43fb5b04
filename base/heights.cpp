#include "trismooth/base/heights.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"

namespace trismooth {

namespace {

constexpr double flatness = 1e-6;  // of the largest extent

/// Numbers from the lowest to the highest of some.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Half of it, so that it does not overflow; 0 of none.
  double half_extent() const { return low <= high ? high / 2 - low / 2 : 0; }
};

/// The shortest text that reads back to the same number.
std::string text_of(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

bool all_equal(const ConstPointView& points) {
  for (std::size_t v = 1; v < points.size(); ++v) {
    if (!(points.z(v) == points.z(0))) {
      return false;
    }
  }
  return true;
}

}  // namespace

void require_one_height(const ConstPointView& points, std::span<const Point2<double>> pairs,
                        const std::function<std::vector<std::uint8_t>()>& fixed) {
  if (all_equal(points)) {
    return;
  }
  const std::vector<std::uint8_t> reasons = fixed();
  Interval x;
  Interval y;
  Interval z;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!hold::is_unused(reasons[v])) {
      x.add(pairs[v].x);
      y.add(pairs[v].y);
      z.add(points.z(v));
    }
  }
  if (!(z.half_extent() <= flatness * std::max(x.half_extent(), y.half_extent()))) {
    throw MeshError(
        "points: z runs from " + text_of(z.low) + " to " + text_of(z.high) +
        ", and must be the same everywhere to within 1e-6 of the mesh's extent; a mesh in a tilted plane is "
        "for smooth() of mesh_io");
  }
}

}  // namespace trismooth
