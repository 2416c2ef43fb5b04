// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/metric_lanes.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "trismooth/base/machine/instruction_set.h"

#include "catch.h"
#include "support/limited_instructions.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using trismooth::CornerPoints;
using trismooth::InstructionSet;
using trismooth::KindValues;
using trismooth::Metric;

TEST_CASE("metrics of triangles side by side have the bits of each metric of each triangle, by all instructions") {
  test_meshes::Random random(7);
  std::vector<CornerPoints> triangles;
  for (int i = 0; i < 5003; ++i) {
    const double scale = std::ldexp(1, i % 4 == 0 ? random.below(300) - 250 : 0);
    CornerPoints corners;
    for (auto& corner : corners) {
      corner = {scale * random.between(-1, 1), scale * random.between(-1, 1) * (i % 5 == 0 ? 1e-12 : 1)};
    }
    if (i % 7 == 0) {  // degenerate, in several ways
      corners[1] = i % 2 == 0 ? corners[0] : trismooth::Point2<double>{2 * corners[0].x, 2 * corners[0].y};
      corners[2] = i % 3 == 0 ? corners[0] : corners[2];
    }
    triangles.push_back(corners);
  }
  for (const InstructionSet most : {InstructionSet::baseline, InstructionSet::avx2}) {
    const LimitedInstructions limited(most);
    std::vector<KindValues<CornerPoints>> values(triangles.size());
    trismooth::evaluate_all(triangles, values);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      for (std::size_t m = 0; m < trismooth::all_metrics().size(); ++m) {
        CAPTURE(t, m);
        REQUIRE(same_bits(values[t][m], trismooth::evaluate(static_cast<Metric>(m), a, b, c)));
      }
    }
  }
}
