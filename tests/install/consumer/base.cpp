// SPDX-License-Identifier: BSD-3-Clause
// The component base alone: points and triangles as views of a caller's arrays, and the version.
#include <array>
#include <cstdint>
#include <cstdio>

#include "trismooth/base/errors.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/point_view.h"
#include "trismooth/version.h"

int main() {
  std::array<double, 6> xy{0, 0, 1, 0, 0, 1};
  const std::array<std::int32_t, 3> triangle{0, 1, 2};
  const trismooth::PointView points = trismooth::xy_points(xy);
  const trismooth::IndexView corners = triangle;
  std::printf("trismooth %s: %zu points, %zu triangles\n", TRISMOOTH_VERSION, points.size(), corners.size());
  return points.size() == 3 && corners.size() == 1 && trismooth::version() == TRISMOOTH_VERSION &&
                 trismooth::library_version() == trismooth::version()
             ? 0
             : 1;
}
