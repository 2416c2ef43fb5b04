#include "trismooth/quality/local_frame.h"

#include <algorithm>

namespace trismooth {

LocalFrame local_frame(std::span<const Point2<double>> stored) {
  if (stored.empty()) {
    return {};
  }
  Point2<double> low = stored.front();
  Point2<double> high = stored.front();
  for (const Point2<double> point : stored) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  return local_frame(low, high);
}

}  // namespace trismooth
