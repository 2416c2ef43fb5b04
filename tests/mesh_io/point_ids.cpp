// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/point_ids.h"

#include <limits>

#include "catch.h"

using trismooth::PointIds;

TEST_CASE("points are found by ids that follow each other, leave few out, or are far apart") {
  constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  for (const std::vector<std::int64_t>& ids :
       {std::vector<std::int64_t>{1, 2, 3}, std::vector<std::int64_t>{0, 1, 2}, std::vector<std::int64_t>{7},
        std::vector<std::int64_t>{3, 1, 2}, std::vector<std::int64_t>{9, 2, 5, 4},
        std::vector<std::int64_t>{-1, 1000000, 17}, std::vector<std::int64_t>{highest, lowest, 0},
        std::vector<std::int64_t>{highest, highest - 1}, std::vector<std::int64_t>{lowest, lowest + 1}}) {
    const PointIds points(ids);
    CHECK_FALSE(points.first_repeated());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      CAPTURE(ids[i]);
      CHECK(points.find(ids[i]) == static_cast<std::int32_t>(i));
    }
    for (const std::int64_t other : {std::int64_t{8}, std::int64_t{-2}, lowest + 9, highest - 9}) {
      CHECK_FALSE(points.find(other));
    }
  }
  CHECK_FALSE(PointIds({}).find(0));
}

TEST_CASE("the first point whose id stands twice is known") {
  CHECK(PointIds({1, 2, 2, 1}).first_repeated() == 2);
  CHECK(PointIds({5, 1000000, 7, 1000000, 5}).first_repeated() == 3);
  CHECK(PointIds({4, 4, 4}).first_repeated() == 1);
}
