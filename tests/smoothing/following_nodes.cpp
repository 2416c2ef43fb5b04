// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using test_meshes::Point;
using trismooth::Triangle;
using trismooth::Workers;

namespace following_nodes_test {

/// Nodes that spoil an element as long as one of its corners is elsewhere.
class SpoilingNodes final : public trismooth::FollowingNodes {
 public:
  SpoilingNodes(const Triangle& element, const std::vector<Point>& before, const std::vector<Point>& after)
      : element_(element), before_(before), after_(after) {}

  void follow(std::int32_t corner) override { followed.push_back(corner); }
  bool is_spoiled(std::span<const std::int32_t> corners, bool is_turned) const override {
    return !is_turned && std::ranges::is_permutation(corners, element_) &&
           std::ranges::any_of(element_, [this](std::int32_t v) { return !(after_[v] == before_[v]); });
  }

  std::vector<std::int32_t> followed;

 private:
  Triangle element_;
  const std::vector<Point>& before_;
  const std::vector<Point>& after_;
};

TEST_CASE("an element that its nodes spoil goes back however good its corners are, and nodes are told of each corner") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.3, 1);
  Workers workers(2);
  const trismooth::OneRings rings = trismooth::find_mesh_rings(mesh.points, mesh.triangles, {}, workers).rings;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 7) {
    // All that moves is better than it was: to the places of the regular grid.
    std::vector<Point> after = test_meshes::jittered_grid(9, 9, 0, 1).points;
    const std::vector<Point> regular = after;
    SpoilingNodes nodes(mesh.triangles[t], mesh.points, after);
    const auto outcome = keep_never_worse(rings.view(), mesh.points, after, workers, {}, nullptr, &nodes);
    std::vector<std::int32_t> expected;
    std::ranges::copy_if(mesh.triangles[t], std::back_inserter(expected), [&](std::int32_t v) {
      return !(regular[static_cast<std::size_t>(v)] == mesh.points[static_cast<std::size_t>(v)]);
    });
    CAPTURE(t);
    for (const std::int32_t v : expected) {
      REQUIRE(std::ranges::binary_search(outcome.reverted, v));
      REQUIRE(same_bits(after[static_cast<std::size_t>(v)], mesh.points[static_cast<std::size_t>(v)]));
    }
    std::ranges::sort(nodes.followed);
    REQUIRE(nodes.followed == outcome.reverted);
    REQUIRE((outcome.rounds > 0) == !expected.empty());
  }
}

}  // namespace following_nodes_test
