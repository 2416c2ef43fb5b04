// SPDX-License-Identifier: BSD-3-Clause
// Ids may be any numbers: the bits are those of a run of the whole.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "mpi/whole_runs.h"
#include "properties/smoothing_cases.h"

using namespace mpi_tests;
using trismooth::Form;
using trismooth::Method;
using trismooth::SmoothingOptions;
using trismooth::Triangle;
using trismooth::mpi::Plan;

namespace {

double smallest_shape(const std::vector<Triangle>& triangles, const std::vector<double>& xy) {
  double smallest = 1;
  const auto point = [&](std::int32_t v) {
    return trismooth::Point2<double>{xy[2 * static_cast<std::size_t>(v)], xy[2 * static_cast<std::size_t>(v) + 1]};
  };
  for (const auto& [a, b, c] : triangles) {
    smallest = std::min(smallest, trismooth::shape(point(a), point(b), point(c)));
  }
  return smallest;
}

}  // namespace

TEST_CASE("numbers that are left out between ids are vertices that nobody has") {
  constexpr std::int32_t stride = 7;
  constexpr std::int32_t offset = 1000;
  const RandomMesh mesh = delaunay_mesh(3000, 4);
  RandomMesh with_gaps;
  with_gaps.mesh.points.resize(static_cast<std::size_t>(offset) +
                               static_cast<std::size_t>(stride) * mesh.mesh.points.size());
  for (std::size_t v = 0; v < mesh.mesh.points.size(); ++v) {
    with_gaps.mesh.points[offset + stride * v] = mesh.mesh.points[v];
  }
  for (const auto& [a, b, c] : mesh.mesh.triangles) {
    with_gaps.mesh.triangles.push_back({offset + stride * a, offset + stride * b, offset + stride * c});
  }
  Piece piece = plain_piece(mesh, in_sectors(mesh));
  for (std::int64_t& id : piece.ids) {
    id = offset + stride * id;
  }
  for (std::int32_t& v : piece.global) {
    v = offset + stride * v;
  }
  draw_owners(piece);
  for (const Form form : {Form::swap, Form::in_place}) {
    const SmoothingOptions options = options_of(Method::smart, form, 1000);
    CHECK(smoothed_piece(piece, options, properties::run(with_gaps, options)) == "");
  }
}

TEST_CASE("ids beyond 32 bits give the same bits on every number of ranks") {
  const RandomMesh mesh = delaunay_mesh(3000, 5);
  const auto far_away = [](std::int64_t id) { return (std::int64_t{1} << 40) + 1000003 * id; };
  const auto with_far_ids = [&](Piece piece) {
    std::ranges::transform(piece.ids, piece.ids.begin(), far_away);
    for (std::int64_t& id : piece.triangle_ids) {
      id += std::int64_t{1} << 50;
    }
    return piece;
  };
  const Piece piece = with_far_ids(plain_piece(mesh, in_strips(mesh)));
  // The whole, by each rank alone.
  std::vector<std::int64_t> ids(mesh.mesh.points.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::ranges::transform(ids, ids.begin(), far_away);
  const trismooth::mpi::LocalMesh all{mesh.mesh.triangles, ids};
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    SmoothingOptions options = properties::combination(index);
    INFO(properties::text_of(options));
    options.max_sweeps = 30;
    Run alone{mesh.mesh.xy(), {}};
    alone.result = Plan(MPI_COMM_SELF, all, options).smooth(alone.xy);
    CHECK(smoothed_piece(piece, options, alone) == "");
    const double before = smallest_shape(mesh.mesh.triangles, mesh.mesh.xy());
    const double after = smallest_shape(mesh.mesh.triangles, alone.xy);
    CHECK(said_by_any(after >= before ? "" : fmt::format("{} is worse than {}", after, before)) == "");
    // Without colours nothing depends on what the ids are but their order.
    if (options.form == Form::swap) {
      CHECK(smoothed_piece(piece, options, properties::run(mesh, options)) == "");
    }
  }
}
