// SPDX-License-Identifier: BSD-3-Clause
// A mesh with quadrilaterals in pieces comes out with the bits of the whole, for every number of ranks and every cut.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mpi/moving_mesh.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "mpi/mixed_pieces.h"
#include "mpi/pieces.h"
#include "mpi/random_pieces.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "support/fake_backend.h"
#include "support/mixed_meshes.h"
#include "support/same_bits.h"
#include "support/says.h"

/// Weak: a program of devices has its own.
[[gnu::weak]] const trismooth::Backend* backend_of_pieces() {
  return nullptr;
}

namespace trismooth::mpi_quadrilaterals_test {

using namespace mixed_pieces;

TEST_CASE("random meshes with quadrilaterals in pieces come out with the bits of the whole") {
  std::mt19937_64 random(20);
  const auto meshes = static_cast<std::uint64_t>(properties::meshes_of(600));
  for (std::uint64_t number = 0; number < meshes; ++number) {
    const Whole whole = any_mesh(random);
    const SmoothingOptions options = any_options(number, random);
    const Cut cut = any_cut(whole, random);
    if (!mpi_tests::is_for_this_job(number)) {
      continue;
    }
    const std::string wrong = in_pieces(whole, cut, options, run_whole(whole, options), number);
    INFO(fmt::format("mesh {}: {}", number, properties::text_of(options)));
    REQUIRE(wrong == "");
  }
}

TEST_CASE("so does a larger one, by every method, form and precision") {
  Whole whole;
  whole.mesh = MixedMesh(70, 70, 0.35, 3);
  std::mt19937_64 random(5);
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    SmoothingOptions options = properties::combination(index);
    options.max_sweeps = 8;
    INFO(properties::text_of(options));
    REQUIRE(in_pieces(whole, any_cut(whole, random), options, run_whole(whole, options)) == "");
  }
}

TEST_CASE("where neighbours and the corners opposite are all of other ranks, a move of any of them is seen") {
  Whole whole;
  whole.mesh = MixedMesh(12, 12, 0.3, 4, 0);
  Cut cut;
  for (std::size_t e = 0; e < whole.mesh.elements.size(); ++e) {
    cut.rank_of_element.push_back(static_cast<int>(e) % ranks());
  }
  // Two rows below the same columns are those of other ranks.
  for (std::int32_t v = 0; v < whole.mesh.vertex_count(); ++v) {
    cut.owners.push_back((v % 13 + 2 * (v / 13)) % ranks());
  }
  for (const Form form : {Form::swap, Form::in_place}) {
    SmoothingOptions options;
    options.form = form;
    options.threads = 1;
    options.tolerance = 0;
    CHECK(in_pieces(whole, cut, options, run_whole(whole, options)) == "");
  }
}

TEST_CASE("layers of quadrilaterals are kept as in the whole, wherever they are cut") {
  // The lowest rows are rectangles eight times as long as high.
  Whole whole;
  whole.mesh = MixedMesh(30, 20, 0.2, 6, 0);
  for (auto& [x, y] : whole.mesh.points) {
    const bool is_low = y < 8.5;
    x = is_low ? std::round(x) : x;
    y = is_low ? std::round(y) / 8 : y - 7;
  }
  std::mt19937_64 random(7);
  SmoothingOptions options;
  options.threads = 1;
  options.max_sweeps = 5;
  const Run expected = run_whole(whole, options);
  CHECK(expected.result.layers.kept > 0);
  for (int i = 0; i < 6; ++i) {
    CHECK(in_pieces(whole, any_cut(whole, random), options, expected) == "");
  }
}

TEST_CASE("quadrilaterals in pieces follow their boundary to the bits of the whole") {
  Whole whole;
  whole.mesh = MixedMesh(20, 16, 0.2, 9);
  std::mt19937_64 random(10);
  const auto bent = [](std::vector<double> xy) {
    for (std::size_t i = 0; i < xy.size(); i += 2) {
      xy[i + 1] += 0.02 * xy[i] * (20 - xy[i]) * xy[i + 1] / 16;
    }
    return xy;
  };
  std::vector<double> expected = bent(whole.mesh.xy());
  const FollowResult of_whole =
      trismooth::MovingMesh(whole.mesh.points, whole.mesh.elements).follow(xy_points(expected));
  REQUIRE(of_whole.is_valid());
  for (int i = 0; i < 4; ++i) {
    const Piece piece = piece_of(whole, any_cut(whole, random), 1);
    trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, xy_points(piece.xy), piece.mesh());
    std::vector<double> xy = bent(piece.xy);
    const FollowResult result = moving.follow(xy_points(xy));
    CHECK(result.is_valid());
    CHECK(same_bits(result.mean_relative_shape, of_whole.mean_relative_shape));
    std::string wrong;
    for (std::size_t k = 0; k < xy.size(); ++k) {
      if (!same_bits(xy[k], expected[2 * static_cast<std::size_t>(piece.ids[k / 2]) + k % 2])) {
        wrong = fmt::format("vertex {}", piece.ids[k / 2]);
      }
    }
    REQUIRE(said_by_any(wrong) == "");
  }
}

TEST_CASE("some ranks may list triangles by three numbers, and others four of each element") {
  // Quadrilaterals on rank 0, triangles on the others.
  const MixedMesh grid(16, 16, 0.3, 8);
  Whole whole;
  Cut cut;
  cut.says_ids = false;
  whole.mesh.points = grid.points;
  for (int r = 0; r < ranks(); ++r) {
    for (std::size_t e = 0; e < grid.elements.size(); ++e) {
      const int to = grid.is_triangle(e) ? static_cast<int>(e) % ranks() : 0;
      if (to == r) {
        whole.mesh.elements.push_back(grid.elements[e]);
        cut.rank_of_element.push_back(r);
      }
    }
  }
  SmoothingOptions options;
  options.threads = 1;
  const Run expected = run_whole(whole, options);
  const Piece piece = piece_of(whole, cut, 1);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Element& element : piece.elements) {
    triangles.push_back({element[0], element[1], element[2]});
  }
  LocalMesh local = piece.mesh();
  if (rank() > 0) {
    local.triangles = triangles;
  }
  std::vector<double> xy = piece.xy;
  const SmoothingResult result = Plan(MPI_COMM_WORLD, local, options).smooth(xy);
  CHECK(said_by_any(difference(piece, xy, result, expected)) == "");
}

TEST_CASE("triangles that are listed by four numbers are smoothed as triangles are") {
  Whole whole;
  whole.mesh = MixedMesh(10, 10, 0.3, 9, 3);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Element& element : whole.mesh.elements) {
    triangles.push_back({element[0], element[1], element[2]});
  }
  std::mt19937_64 random(10);
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.threads = 1;
  Run expected{whole.mesh.xy(), {}};
  expected.result = trismooth::plan(whole.mesh.vertex_count(), triangles, options).smooth(expected.xy);
  CHECK(in_pieces(whole, any_cut(whole, random), options, expected) == "");
}

/// The error of a plan whose elements `spoil` changes on this rank, and whether all ranks say the same.
std::string error_of(const std::function<void(Piece&)>& spoil, const SmoothingOptions& options = {}) {
  Whole whole;
  whole.mesh = MixedMesh(8, 8, 0.2, 11, 0);
  Cut cut;
  for (std::size_t e = 0; e < whole.mesh.elements.size(); ++e) {
    cut.rank_of_element.push_back(static_cast<int>(e) % ranks());
  }
  cut.says_ids = false;
  Piece piece = piece_of(whole, cut, 1);
  spoil(piece);
  std::string said = "nothing";
  try {
    (void)Plan(MPI_COMM_WORLD, piece.mesh(), options);
  } catch (const MeshError& error) {
    said = std::string("MeshError: ") + error.what();
  } catch (const std::invalid_argument& error) {
    said = std::string("invalid_argument: ") + error.what();
  }
  return mpi_tests::say_the_same(said) ? said : "something else on each rank";
}

TEST_CASE("a quadrilateral that is none on one rank is told of on all") {
  const int last = ranks() - 1;
  const std::string on_last = ranks() > 1 ? fmt::format("MeshError: rank {}: ", last) : "MeshError: ";
  const auto on_last_rank = [last](const auto& spoil) {
    return error_of([&](Piece& piece) {
      if (rank() == last) {
        spoil(piece);
      }
    });
  };
  CHECK(on_last_rank([](Piece& piece) { piece.elements[3][2] = piece.elements[3][0]; }) ==
        on_last + "element 3 repeats a vertex");
  CHECK(on_last_rank([](Piece& piece) { piece.elements[2][3] = piece.elements[2][2]; }) ==
        on_last + "element 2 repeats a vertex; of a triangle the last of four numbers is -1");
  CHECK(on_last_rank([](Piece& piece) { piece.elements[1][1] = -1; }) ==
        on_last + "element 1 names vertex -1, which is no vertex: only the last of four numbers is -1, of a triangle");
  CHECK(says(on_last_rank([](Piece& piece) { piece.elements[0][3] = 5000; }), on_last + "element 0 names vertex 5000"));
}

TEST_CASE("a quadrilateral on two ranks that neither calls a copy is refused by the ids of its corners") {
  if (ranks() == 1) {
    return;
  }
  const std::string said = error_of([](Piece& piece) {
    // The first one, of vertices 0, 1, 9 and 10, on rank 1 as well.
    if (rank() == 1) {
      Element copy{};
      for (std::size_t i = 0; const std::int64_t id : {0, 1, 10, 9}) {
        const auto place = std::ranges::find(piece.ids, id);
        copy[i++] = static_cast<std::int32_t>(place - piece.ids.begin());
        if (place == piece.ids.end()) {
          const auto column = static_cast<double>(id % 9);
          piece.ids.push_back(id);
          piece.xy.insert(piece.xy.end(), {column, 0});
        }
      }
      piece.elements.push_back(copy);
      piece.ghosts.push_back(0);
    }
  });
  CHECK(says(said,
             "the quadrilateral of vertex ids 0, 1, 9 and 10 is on rank 0 and "
             "on rank 1; copies are to be in ghost_triangles"));
}

TEST_CASE("corners that are not listed in turn are named as what may be wrong") {
  // Of an element in the middle, which contradicts those on two sides of it then.
  constexpr int middle = 27;
  const std::string said = error_of([](Piece& piece) {
    if (rank() == middle % ranks()) {
      Element& element = piece.elements[static_cast<std::size_t>(middle / ranks())];
      std::swap(element[1], element[2]);
    }
  });
  CHECK(says(said, "MeshError"));
  CHECK(says(said, "or a quadrilateral whose corners are not listed in turn"));
}

TEST_CASE(
    "a backend that has no way for quadrilaterals in pieces is refused, or rank 0's CPU smooths all and says so") {
  const fakes::FakeBackend fake;
  SmoothingOptions options;
  options.threads = 1;
  options.backend = &fake;
  CHECK(says(error_of([](Piece&) {}, options), "Gather::where_needed"));
  Whole whole;
  whole.mesh = MixedMesh(9, 9, 0.3, 12);
  std::mt19937_64 random(13);
  const Cut cut = any_cut(whole, random);
  const Piece piece = piece_of(whole, cut, 1);
  std::vector<double> xy = piece.xy;
  const SmoothingResult result = Plan(MPI_COMM_WORLD, piece.mesh(), options, Gather::where_needed).smooth(xy);
  options.backend = nullptr;
  CHECK(said_by_any(difference(piece, xy, result, run_whole(whole, options))) == "");
  CHECK(says(result.backend_note, "the CPU of rank 0"));
}

}  // namespace trismooth::mpi_quadrilaterals_test
