// SPDX-License-Identifier: BSD-3-Clause
// A mesh in pieces follows its boundary as the whole does.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mpi/moving_mesh.h"

#include "catch.h"
#include "mpi/random_pieces.h"
#include "mpi/whole_runs.h"
#include "properties/for_random_meshes.h"
#include "properties/moved_boundary.h"
#include "support/refusal.h"
#include "support/rotor.h"
#include "support/same_bits.h"

using namespace mpi_tests;
using test_meshes::Point;
using test_support::refusal;
using trismooth::FollowResult;
using trismooth::MovingStart;
using Points = std::vector<Point>;

namespace {

/// What is said of a mesh on one rank and not of the whole.
std::string unlike_whole(const Piece& piece, const FollowResult& found, const FollowResult& whole) {
  const auto same = [](double a, double b) { return same_bits(a, b) || (std::isnan(a) && std::isnan(b)); };
  std::string wrong;
  const auto check = [&wrong](const char* what, bool is_same) { wrong += is_same ? "" : std::string(what) + " "; };
  check("smallest shape", same(found.min_relative_shape, whole.min_relative_shape));
  check("mean shape", same(found.mean_relative_shape, whole.mean_relative_shape));
  check("largest move", same(found.largest_move, whole.largest_move));
  check("held invalid", found.invalid_held == whole.invalid_held);
  check("crossings", found.crossings == whole.crossings);
  check("overlaps", found.overlaps == whole.overlaps);
  check("invalid", found.invalid == whole.invalid);
  check("inverted", found.smoothing.inverted == whole.smoothing.inverted);
  check("degenerate", found.smoothing.degenerate == whole.smoothing.degenerate);
  check("sweeps", found.smoothing.sweeps == whole.smoothing.sweeps);
  check("moved", found.smoothing.moved_vertices == whole.smoothing.moved_vertices);
  check("layers", found.smoothing.layers.kept == whole.smoothing.layers.kept);
  check("backend", found.smoothing.backend == whole.smoothing.backend);
  check("reverted", found.smoothing.reverted_vertices == whole.smoothing.reverted_vertices);
  for (const trismooth::RevertedVertex& reverted : found.smoothing.reverted) {
    const std::int32_t v = piece.global[static_cast<std::size_t>(reverted.vertex)];
    const auto place = std::ranges::find(whole.smoothing.reverted, v, &trismooth::RevertedVertex::vertex);
    check("went back", place != whole.smoothing.reverted.end() && same_bits(place->position, reverted.position));
  }
  return wrong;
}

std::string elsewhere(const Points& points, const Points& expected) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!same_bits(points[v], expected[v])) {
      return fmt::format("local vertex {} is elsewhere ", v);
    }
  }
  return "";
}

RandomMesh rotor_mesh(const test_meshes::Rotor& rotor) {
  RandomMesh mesh;
  mesh.mesh = rotor.mesh;
  return mesh;
}

}  // namespace

TEST_CASE("random meshes in pieces follow whatever their boundary does to the bits of the whole") {
  properties::for_random_meshes(400, [](const RandomMesh& random) -> std::string {
    if (!is_for_this_job(random.seed)) {
      return {};
    }
    trismooth::MovingMesh whole(random.mesh.points, random.mesh.indices(), random.constraints());
    const std::vector<std::uint8_t> held = whole.held();
    const Piece piece = piece_of(random, static_cast<Cut>(random.seed % cuts), random.seed);
    const Points reference = piece.local(random.mesh.points);
    trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, reference, piece.mesh(), piece.constraints());
    std::string wrong = moving.held() == piece.local(held) ? "" : "other vertices are held ";
    std::uint64_t seed = random.seed;
    for (const MovingStart start : {MovingStart::reference, MovingStart::previous, MovingStart::reference}) {
      Points points = properties::moved_boundary(random, held, seed++);
      if (std::ranges::any_of(points, [](Point p) { return !std::isfinite(p.x) || !std::isfinite(p.y); })) {
        continue;  // of meshes as large as numbers are
      }
      Points own = piece.local(points);
      const FollowResult expected = whole.follow(points, start);
      const FollowResult found = moving.follow(own, start);
      wrong += elsewhere(own, piece.local(points)) + unlike_whole(piece, found, expected);
      if (seed == random.seed + 1) {
        whole.go_on_from(random.mesh.points);
        moving.go_on_from(reference);
      } else if (random.seed % 2 == 0) {
        whole.take_back();
        moving.take_back();
      }
    }
    wrong += elsewhere(moving.points(), piece.local(whole.points()));
    return said_by_any(wrong);
  });
}

TEST_CASE("a rotor in pieces comes back to its first mesh to the bit, float or double, with heights or without") {
  const test_meshes::Rotor rotor;
  const RandomMesh mesh = rotor_mesh(rotor);
  const Piece piece = plain_piece(mesh, in_sectors(mesh));
  const auto check = [&]<class T, std::size_t n>(std::array<T, n> /*of this type*/) {
    const auto at = [&](double angle) {
      std::vector<std::array<T, n>> points;
      for (const Point p : piece.local(rotor.at(angle))) {
        points.push_back({static_cast<T>(p.x), static_cast<T>(p.y)});
        if constexpr (n == 3) {
          points.back()[2] = T{2.5};
        }
      }
      return points;
    };
    const auto reference = piece.local(rotor.mesh.points);
    trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, reference, piece.mesh());
    auto first = at(0);
    moving.follow(first);
    std::string wrong;
    for (const double angle : {0.4, 0.9, -0.3, 0.0}) {
      auto points = at(angle);
      const FollowResult result = moving.follow(points, angle > 0.5 ? MovingStart::previous : MovingStart::reference);
      wrong += result.smoothing.inverted == 0 ? "" : fmt::format("inverted at {} ", angle);
      wrong += angle == 0 && points != first ? "it has drifted" : "";
    }
    CHECK(said_by_any(wrong) == "");
  };
  check(std::array<float, 2>{});
  check(std::array<double, 2>{});
  check(std::array<double, 3>{});
}

TEST_CASE("ranks without vertices have no say in the type of the numbers") {
  const test_meshes::Rotor rotor;
  const RandomMesh mesh = rotor_mesh(rotor);
  const Piece piece = plain_piece(mesh, std::vector<int>(mesh.mesh.triangles.size(), ranks() - 1));
  const Points reference = piece.local(rotor.mesh.points);
  trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, reference, piece.mesh());
  trismooth::MovingMesh whole(rotor.mesh.points, rotor.mesh.indices());
  std::vector<std::array<float, 2>> expected;
  for (const Point p : rotor.at(0.3)) {
    expected.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  }
  std::vector<std::array<float, 2>> points = piece.local(expected);
  whole.follow(expected);
  if (points.empty()) {
    Points none;
    moving.follow(none);
  } else {
    moving.follow(points);
  }
  CHECK(said_by_any(points == piece.local(expected) ? "" : "other points") == "");
  CHECK(said_by_any(elsewhere(moving.points(), piece.local(whole.points()))) == "");
}

TEST_CASE("numbers that are left out between ids of a mesh that moves are vertices that nobody has") {
  constexpr std::int32_t stride = 3;
  const test_meshes::Rotor rotor;
  RandomMesh with_gaps;
  with_gaps.mesh.points.resize(stride * rotor.mesh.points.size());
  for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
    with_gaps.mesh.points[stride * v + 1] = rotor.at(0.3)[v];
  }
  Points reference(with_gaps.mesh.points.size());
  for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
    reference[stride * v + 1] = rotor.mesh.points[v];
  }
  for (const auto& [a, b, c] : rotor.mesh.triangles) {
    with_gaps.mesh.triangles.push_back({stride * a + 1, stride * b + 1, stride * c + 1});
  }
  trismooth::MovingMesh whole(reference, with_gaps.mesh.indices());
  Points expected = with_gaps.mesh.points;
  whole.follow(expected);
  const RandomMesh plain = rotor_mesh(rotor);
  Piece piece = plain_piece(plain, scattered(plain));
  for (std::int64_t& id : piece.ids) {
    id = stride * id + 1;
  }
  Points points = piece.local(rotor.at(0.3));
  const Points own_reference = piece.local(rotor.mesh.points);
  trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, own_reference, piece.mesh());
  moving.follow(points);
  std::string wrong;
  for (std::size_t i = 0; i < points.size(); ++i) {
    wrong = same_bits(points[i], expected[static_cast<std::size_t>(piece.ids[i])]) ? wrong : "another place";
  }
  CHECK(said_by_any(wrong) == "");
}

TEST_CASE("what is wrong on one rank with a mesh that moves is said on all, and nothing has changed") {
  const test_meshes::Rotor rotor;
  const RandomMesh mesh = rotor_mesh(rotor);
  Piece piece = plain_piece(mesh, in_strips(mesh));
  const bool is_last = rank() == ranks() - 1;
  const auto says = [](const std::string& own, const std::string& part) {
    return said_by_any(own.find(part) != std::string::npos ? "" : own);
  };
  const Points reference = piece.local(mesh.mesh.points);
  const auto made = [&](trismooth::Constraints constraints, trismooth::SmoothingOptions options) {
    return refusal([&] {
      const trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, reference, piece.mesh(), constraints, options);
    });
  };
  trismooth::Constraints slides;
  slides.slide.along = trismooth::Slide::straight;
  CHECK(says(made(slides, trismooth::moving_options()), "argument: ") == "");
  trismooth::SmoothingOptions differs = trismooth::moving_options();
  differs.max_sweeps += is_last && ranks() > 1 ? 1 : 0;
  CHECK(says(made({}, differs), ranks() > 1 ? "argument: " : "none") == "");

  trismooth::mpi::MovingMesh moving(MPI_COMM_WORLD, reference, piece.mesh());
  const Points before = moving.points();
  Points points = piece.local(rotor.at(0.2));
  if (is_last) {
    points.back().x = std::numeric_limits<double>::quiet_NaN();
  }
  const Points given = points;
  CHECK(says(refusal([&] { moving.follow(points); }), "mesh: ") == "");
  CHECK(elsewhere(points, given).empty());
  points = piece.local(rotor.at(0.2));
  if (is_last) {
    points.pop_back();
  }
  CHECK(says(refusal([&] { moving.go_on_from(points); }), "argument: ") == "");
  CHECK(says(refusal([&] { moving.follow(points); }), "local vertices") == "");
  CHECK(said_by_any(elsewhere(moving.points(), before)) == "");

  points = piece.local(rotor.at(0.2));
  const std::string of_start =
      refusal([&] { (void)moving.follow(points, is_last ? MovingStart::previous : MovingStart::reference); });
  CHECK(says(of_start, ranks() > 1 ? "start" : "none") == "");
  if (ranks() == 1) {
    moving.take_back();
  }
  CHECK_THROWS_AS(moving.take_back(), std::logic_error);

  if (is_last) {
    piece.ids.back() = std::int64_t{1} << 31;
  }
  const std::string of_ids = made({}, trismooth::moving_options());
  CHECK(says(of_ids, "vertex_ids: ") == "");
  CHECK(says(of_ids, ranks() > 1 ? fmt::format("rank {}: ", ranks() - 1) : "2147483648 is above that") == "");
}
