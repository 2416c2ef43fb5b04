// SPDX-License-Identifier: BSD-3-Clause
// Larger meshes, cut as programs cut them and as none would: the bits are those of a run of the whole.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "catch.h"
#include "mpi/whole_runs.h"
#include "properties/smoothing_cases.h"
#include "support/test_meshes.h"

using namespace mpi_tests;
using trismooth::Form;
using trismooth::Method;
using trismooth::SmoothingOptions;

namespace {

constexpr std::int32_t large = 6000;

}  // namespace

TEST_CASE("every method, form and precision, with and without the guard, gives a large mesh in strips the same bits") {
  const RandomMesh mesh = delaunay_mesh(large, 1);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    SmoothingOptions options = properties::combination(index);
    options.max_sweeps = 6;
    // Jobs of an even number of ranks guard what those of an odd one do not.
    options.guard = (index + static_cast<std::uint64_t>(ranks())) % 2 == 0;
    INFO(properties::text_of(options));
    CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == "");
  }
}

TEST_CASE("so does every cut, whoever owns what") {
  const RandomMesh mesh = delaunay_mesh(large, 2);
  SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  const Run whole = properties::run(mesh, options);
  options.threads = 3;
  const std::vector<std::pair<const char*, std::vector<int>>> named_cuts{
      {"strips", in_strips(mesh)}, {"sectors", in_sectors(mesh)}, {"scattered", scattered(mesh)}};
  for (const auto& [name, cut] : named_cuts) {
    INFO(name);
    Piece piece = plain_piece(mesh, cut);
    CHECK(smoothed_piece(piece, options, whole) == "");
    draw_owners(piece);
    CHECK(smoothed_piece(piece, options, whole) == "");
    all_owned_by(piece, ranks() - 1);
    CHECK(smoothed_piece(piece, options, whole) == "");
  }
}

TEST_CASE("ranks that have nothing, or ghosts alone, are ranks like others") {
  const RandomMesh mesh = delaunay_mesh(2000, 3);
  for (const Form form : {Form::swap, Form::in_place}) {
    const SmoothingOptions options = options_of(Method::mean_ratio, form, 40);
    const Run whole = properties::run(mesh, options);
    const std::vector<int> on_first(mesh.mesh.triangles.size(), 0);
    const std::vector<int> on_last(mesh.mesh.triangles.size(), ranks() - 1);
    CHECK(smoothed_piece(plain_piece(mesh, on_last), options, whole) == "");
    Piece piece = plain_piece(mesh, on_first);
    // The last rank owns all, and has none of it.
    all_owned_by(piece, ranks() - 1);
    CHECK(smoothed_piece(piece, options, whole) == "");
    // It has all triangles as copies, and owns none of their vertices.
    if (ranks() > 1 && rank() == ranks() - 1) {
      std::vector<int> mine(mesh.mesh.triangles.size(), rank());
      piece = plain_piece(mesh, mine);
      piece.ghosts.assign(piece.triangles.size(), 1);
    }
    all_owned_by(piece, 0);
    CHECK(smoothed_piece(piece, options, whole) == "");
  }
}

TEST_CASE("meshes of as many vertices as ranks, and of fewer, come out as whole ones") {
  // A star: its middle alone is free. The rank of its middle is the last one, that of the others is drawn.
  for (std::int32_t size = 3; size <= 3 + ranks(); ++size) {
    RandomMesh star;
    star.mesh = test_meshes::star(size);
    std::vector<int> in_turn(star.mesh.triangles.size());
    for (std::size_t t = 0; t < in_turn.size(); ++t) {
      in_turn[t] = static_cast<int>(t) % ranks();
    }
    Piece piece = plain_piece(star, in_turn);
    draw_owners(piece);
    for (const Form form : {Form::swap, Form::in_place}) {
      const SmoothingOptions options = options_of(Method::smart, form);
      CHECK(smoothed_piece(piece, options, properties::run(star, options)) == "");
    }
  }
  // A vertex a rank: each owns the one whose number it has.
  RandomMesh few;
  few.mesh = test_meshes::star(std::max(3, ranks() - 1));
  Piece piece = plain_piece(few, std::vector<int>(few.mesh.triangles.size(), 0));
  for (const std::int64_t id : piece.ids) {
    piece.owners.push_back(static_cast<std::int32_t>(id % ranks()));
  }
  const SmoothingOptions options = options_of(Method::smart, Form::in_place);
  CHECK(smoothed_piece(piece, options, properties::run(few, options)) == "");
  // Nothing anywhere.
  const RandomMesh none;
  CHECK(smoothed_piece(plain_piece(none, {}), options, properties::run(none, options)) == "");
}
