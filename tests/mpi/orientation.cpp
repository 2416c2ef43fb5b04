// SPDX-License-Identifier: BSD-3-Clause
// Triangles that are listed in both ways, on several ranks, are oriented as those of the whole.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "catch.h"
#include "mpi/whole_runs.h"
#include "properties/smoothing_cases.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

using namespace mpi_tests;
using test_meshes::Random;
using trismooth::Form;
using trismooth::Method;
using trismooth::SmoothingOptions;
using trismooth::Triangle;

namespace {

/// A mesh folded along its middle: as many triangles are listed one way as the other.
RandomMesh folded(std::uint64_t seed) {
  RandomMesh mesh;
  mesh.mesh = test_meshes::jittered_grid(13, 9, 0.2, seed);
  for (auto& p : mesh.mesh.points) {
    p.x = std::abs(p.x - 0.5);
  }
  for (std::int32_t row = 0; row < 9; ++row) {
    mesh.mesh.points[13 * static_cast<std::size_t>(row) + 6].x = 0;
  }
  return mesh;
}

/// The same mesh with its triangles in another order: number order[t] becomes number t.
RandomMesh with_triangles_in_order(RandomMesh mesh, const std::vector<std::size_t>& order) {
  const std::vector<Triangle> old = mesh.mesh.triangles;
  for (std::size_t t = 0; t < order.size(); ++t) {
    mesh.mesh.triangles[t] = old[order[t]];
  }
  return mesh;
}

}  // namespace

TEST_CASE("where as many triangles are listed one way as the other, triangle ids decide") {
  bool do_ids_matter = false;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomMesh mesh = folded(seed);
    Random random(seed);
    std::vector<std::size_t> order(mesh.mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    random.shuffle(order);
    mesh = with_triangles_in_order(mesh, order);
    const std::vector<int> cut = scattered(mesh);
    const SmoothingOptions options = options_of(Method::smart, Form::in_place);
    Piece piece = plain_piece(mesh, cut);
    const Run whole = properties::run(mesh, options);
    CHECK(smoothed_piece(piece, options, whole) == "");
    std::ranges::reverse(order);
    do_ids_matter |= !same_bits(properties::run(with_triangles_in_order(folded(seed), order), options).xy, whole.xy);
    // Without ids they are numbered rank by rank.
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t t) { return std::pair(cut[t], t); });
    piece.triangle_ids.clear();
    CHECK(smoothed_piece(piece, options, properties::run(with_triangles_in_order(mesh, order), options)) == "");
  }
  CHECK(do_ids_matter);
}

TEST_CASE("a component that goes from rank to rank many times is listed one way on all of them") {
  for (const std::size_t period : {std::size_t{2}, std::size_t{3}, std::size_t{7}}) {
    RandomMesh band;
    band.mesh = test_meshes::partly_reversed(test_meshes::jittered_grid(301, 3, 0.2, 1), period);
    // Squares one after the other, first along one row of them and then along the other.
    std::vector<int> in_turn(band.mesh.triangles.size());
    for (std::size_t t = 0; t < in_turn.size(); ++t) {
      in_turn[t] = static_cast<int>(t / 2) % ranks();
    }
    const SmoothingOptions options = options_of(Method::smart, Form::in_place);
    CHECK(smoothed_piece(plain_piece(band, in_turn), options, properties::run(band, options)) == "");
  }
}
