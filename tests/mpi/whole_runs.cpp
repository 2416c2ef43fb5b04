// SPDX-License-Identifier: BSD-3-Clause
#include "mpi/whole_runs.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "trismooth/base/splitmix64.h"
#include "trismooth/pipeline/generate/delaunay.h"

#include "support/same_bits.h"
#include "support/test_meshes.h"

using test_meshes::Random;
using trismooth::Form;
using trismooth::Method;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::Triangle;
using trismooth::mpi::Plan;

namespace mpi_tests {

namespace {

/// By the place of its first corner.
std::vector<int> cut_by(const RandomMesh& mesh, const std::function<int(trismooth::Point2<double>)>& rank_at) {
  std::vector<int> rank_of_triangle;
  for (const Triangle& t : mesh.mesh.triangles) {
    rank_of_triangle.push_back(std::clamp(rank_at(mesh.mesh.points[static_cast<std::size_t>(t[0])]), 0, ranks() - 1));
  }
  return rank_of_triangle;
}

}  // namespace

RandomMesh delaunay_mesh(std::int32_t vertices, std::uint64_t seed) {
  Random random(seed);
  std::set<trismooth::GridPoint> known;
  std::vector<trismooth::GridPoint> points;
  while (static_cast<std::int32_t>(points.size()) < vertices) {
    const trismooth::GridPoint point{random.below(1 << 28), random.below(1 << 28)};
    if (known.insert(point).second) {
      points.push_back(point);
    }
  }
  RandomMesh mesh;
  mesh.mesh.triangles = trismooth::delaunay(points);
  for (const auto& [x, y] : points) {
    mesh.mesh.points.push_back({x * 0x1p-28, y * 0x1p-28});
  }
  return mesh;
}

std::vector<int> in_strips(const RandomMesh& mesh) {
  return cut_by(mesh, [](auto p) { return static_cast<int>(p.x * ranks()); });
}

std::vector<int> in_sectors(const RandomMesh& mesh) {
  return cut_by(mesh,
                [](auto p) { return static_cast<int>((std::atan2(p.y - 0.5, p.x - 0.5) / 6.2832 + 0.5) * ranks()); });
}

std::vector<int> scattered(const RandomMesh& mesh) {
  std::vector<int> rank_of_triangle;
  for (std::uint64_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    rank_of_triangle.push_back(static_cast<int>(trismooth::splitmix64(t) % static_cast<std::uint64_t>(ranks())));
  }
  return rank_of_triangle;
}

void draw_owners(Piece& piece) {
  piece.owners.clear();
  for (const std::int64_t id : piece.ids) {
    piece.owners.push_back(
        static_cast<std::int32_t>(trismooth::splitmix64(static_cast<std::uint64_t>(id) + 77) % ranks()));
  }
}

void all_owned_by(Piece& piece, std::int32_t owner) {
  piece.owners.assign(piece.ids.size(), owner);
}

SmoothingOptions options_of(Method method, Form form, std::int64_t sweeps) {
  SmoothingOptions options;
  options.method = method;
  options.form = form;
  options.max_sweeps = sweeps;
  options.threads = 1;
  return options;
}

std::string not_as_whole(const Piece& piece, const std::vector<double>& xy, const SmoothingResult& found,
                         const Run& whole) {
  for (std::size_t i = 0; i < piece.global.size(); ++i) {
    const auto v = static_cast<std::size_t>(piece.global[i]);
    if (!same_bits(xy[2 * i], whole.xy[2 * v]) || !same_bits(xy[2 * i + 1], whole.xy[2 * v + 1])) {
      return fmt::format("vertex {} is at ({}, {}) instead of ({}, {})", v, xy[2 * i], xy[2 * i + 1], whole.xy[2 * v],
                         whole.xy[2 * v + 1]);
    }
  }
  const auto figures = [](const SmoothingResult& r) {
    return fmt::format("{} sweeps, {}, {} updates, {} moved, {} reverted in {} rounds, {} free, {} colours", r.sweeps,
                       to_string(r.stop_reason), r.vertex_updates, r.moved_vertices, r.reverted_vertices,
                       r.guard_rounds, r.free_vertices, r.colours);
  };
  return figures(found) == figures(whole.result)
             ? ""
             : fmt::format("{} instead of {}", figures(found), figures(whole.result));
}

std::string smoothed_piece(const Piece& piece, const SmoothingOptions& options, const Run& whole) {
  std::vector<double> xy = piece.xy;
  std::string wrong;
  try {
    const SmoothingResult result = Plan(MPI_COMM_WORLD, piece.mesh(), piece.constraints(), options).smooth(xy);
    wrong = not_as_whole(piece, xy, result, whole);
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  return said_by_any(wrong);
}

}  // namespace mpi_tests
