// SPDX-License-Identifier: BSD-3-Clause
// Points, sizes, limits and constraints of a call mean on ranks what they mean for the whole.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "mpi/whole_runs.h"
#include "properties/smoothing_cases.h"
#include "support/same_bits.h"

using namespace mpi_tests;
using trismooth::Form;
using trismooth::Method;
using trismooth::SmoothingOptions;
using trismooth::Triangle;
using trismooth::mpi::Plan;

TEST_CASE("points of float, and of three numbers, are smoothed as those of the whole") {
  const RandomMesh mesh = delaunay_mesh(3000, 6);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  const SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  const auto check = [&]<class T>(T height) {
    const bool has_heights = height != 0;
    const auto numbers_of = [&](const std::vector<double>& xy) {
      std::vector<T> numbers;
      for (std::size_t i = 0; i < xy.size(); i += 2) {
        numbers.insert(numbers.end(), {static_cast<T>(xy[i]), static_cast<T>(xy[i + 1])});
        if (has_heights) {
          numbers.push_back(height);
        }
      }
      return numbers;
    };
    const auto view_of = [&](std::vector<T>& numbers) {
      return has_heights ? trismooth::xyz_points(numbers) : trismooth::xy_points(numbers);
    };
    std::vector<T> whole = numbers_of(mesh.mesh.xy());
    trismooth::smooth(view_of(whole), mesh.mesh.triangles, options);
    std::vector<T> own = numbers_of(piece.xy);
    Plan(MPI_COMM_WORLD, piece.mesh(), options).smooth(view_of(own));
    const std::size_t numbers = has_heights ? 3 : 2;
    std::string wrong;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto v = static_cast<std::size_t>(piece.global[i / numbers]);
      if (!same_bits(own[i], whole[numbers * v + i % numbers])) {
        wrong = fmt::format("vertex {} is elsewhere", v);
      }
    }
    CHECK(said_by_any(wrong) == "");
  };
  check(0.0F);
  check(0.0);
  check(2.5F);
  check(2.5);
}

TEST_CASE("double points that are to be stored as float are rounded as those of the whole") {
  const RandomMesh mesh = delaunay_mesh(3000, 7);
  const Piece piece = plain_piece(mesh, scattered(mesh));
  const SmoothingOptions options = options_of(Method::smart, Form::swap, 1000);
  const Run whole = properties::run(mesh, options, trismooth::Storage::float32);
  std::vector<double> xy = piece.xy;
  const auto result = Plan(MPI_COMM_WORLD, piece.mesh(), options).smooth(xy, trismooth::Storage::float32);
  CHECK(said_by_any(not_as_whole(piece, xy, result, whole)) == "");
}

TEST_CASE("a plan aims at sizes that are asked for, at other ones in the next call") {
  const RandomMesh mesh = delaunay_mesh(3000, 8);
  Piece piece = plain_piece(mesh, in_sectors(mesh));
  draw_owners(piece);
  std::vector<double> all_lengths(mesh.mesh.points.size());
  std::vector<double> lengths(piece.ids.size());
  SmoothingOptions options = options_of(Method::mean_ratio, Form::in_place, 30);
  options.mean_ratio.target_lengths = lengths;
  Plan plan(MPI_COMM_WORLD, piece.mesh(), options);
  for (const double power : {1.0, -2.0}) {
    for (std::size_t v = 0; v < all_lengths.size(); ++v) {
      all_lengths[v] = std::pow(1.1 + mesh.mesh.points[v].x, power);
    }
    std::ranges::copy(piece.local(all_lengths), lengths.begin());
    SmoothingOptions of_whole = options;
    of_whole.mean_ratio.target_lengths = all_lengths;
    std::vector<double> xy = piece.xy;
    const auto result = plan.smooth(xy);
    CHECK(said_by_any(not_as_whole(piece, xy, result, properties::run(mesh, of_whole))) == "");
  }
}

TEST_CASE("a plan is used again where the boundary has moved, and where the mesh is turned over") {
  const RandomMesh mesh = delaunay_mesh(3000, 9);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  const SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  Plan plan(MPI_COMM_WORLD, piece.mesh(), options);
  std::vector<double> xy = piece.xy;
  RandomMesh moved = mesh;
  for (int step = 1; step <= 4; ++step) {
    const auto move = [step](double& x, double& y) {
      y *= 1 + 0.05 * step * x;
      x = step == 3 ? -x : x;
    };
    for (auto& p : moved.mesh.points) {
      move(p.x, p.y);
    }
    for (std::size_t i = 0; i < xy.size(); i += 2) {
      move(xy[i], xy[i + 1]);
    }
    const Run whole = properties::run(moved, options);
    const auto result = plan.smooth(xy);
    CHECK(said_by_any(not_as_whole(piece, xy, result, whole)) == "");
    moved = properties::at_points(moved, whole.xy);
  }
}

TEST_CASE("limits end all ranks after the same sweep") {
  const RandomMesh mesh = delaunay_mesh(3000, 10);
  const Piece piece = plain_piece(mesh, in_strips(mesh));
  for (const Form form : {Form::swap, Form::in_place}) {
    SmoothingOptions options = options_of(Method::smart, form, 0);
    const auto check = [&] { CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == ""); };
    check();
    options.max_sweeps = 1;
    check();
    options.max_sweeps = 0;
    options.time_limit_seconds = 0;
    check();
    options.time_limit_seconds = std::numeric_limits<double>::infinity();
    options.target_quality = 0.01;
    check();
    options.target_quality = -1;  // it is there before the first sweep
    check();
    options.target_quality.reset();
    options.tolerance = 0.1;
    check();
  }
}

TEST_CASE("regions and vertices that are held are so on all ranks, whoever says so") {
  RandomMesh mesh = delaunay_mesh(3000, 11);
  for (const Triangle& t : mesh.mesh.triangles) {
    mesh.regions.push_back(mesh.mesh.points[static_cast<std::size_t>(t[0])].y < 0.4 ? 3 : -1);
  }
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); v += 50) {
    mesh.fixed_ids.push_back(v);
  }
  Piece piece = plain_piece(mesh, in_strips(mesh));
  for (const std::int64_t t : piece.triangle_ids) {
    piece.regions.push_back(mesh.regions[static_cast<std::size_t>(t)]);
  }
  // Of the ranks that have a vertex the highest says that it is held.
  std::vector<int> last(mesh.mesh.points.size(), -1);
  const std::vector<int> cut = in_strips(mesh);
  for (std::size_t t = 0; t < cut.size(); ++t) {
    for (const std::int32_t v : mesh.mesh.triangles[t]) {
      last[static_cast<std::size_t>(v)] = std::max(last[static_cast<std::size_t>(v)], cut[t]);
    }
  }
  for (std::size_t i = 0; i < piece.global.size(); ++i) {
    if (const std::int32_t v = piece.global[i]; v % 50 == 0 && last[static_cast<std::size_t>(v)] == rank()) {
      piece.fixed_ids.push_back(static_cast<std::int32_t>(i));
    }
  }
  const SmoothingOptions options = options_of(Method::smart, Form::in_place, 1000);
  CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == "");
}
