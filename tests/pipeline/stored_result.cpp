// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/stored_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/stages/document_mesh.h"
#include "trismooth/pipeline/stages/staged_run.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/quadratic_samples.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::stored_result_test {

using test_meshes::Mesh;
using test_meshes::Point;

/// The mesh with a node in the middle of every side, behind the corners; off the middle by up to `bend` sides.
MeshDocument quadratic(const Mesh& mesh, double bend, std::uint64_t seed) {
  test_meshes::Random random(seed);
  MeshDocument document = triangle_document(mesh, 2.5);
  document.cells = {};
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [found, is_new] = middles.emplace(std::minmax(a, b), static_cast<std::int32_t>(document.point_count()));
    if (is_new) {
      const Point p = mesh.points[static_cast<std::size_t>(a)];
      const Point q = mesh.points[static_cast<std::size_t>(b)];
      const double reach = bend * std::hypot(p.x - q.x, p.y - q.y);
      document.points.insert(document.points.end(), {(p.x + q.x) / 2 + random.between(-reach, reach),
                                                     (p.y + q.y) / 2 + random.between(-reach, reach), 2.5});
    }
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<std::int32_t, 3> nodes{middle(a, b), middle(b, c), middle(c, a)};
    document.cells.append(cell_type::quadratic_triangle,
                          std::vector<std::int32_t>{a, b, c, nodes[0], nodes[1], nodes[2]});
  }
  return document;
}

struct Smoothed {
  MeshDocument before;
  MeshDocument after;
  PipelineResult result;
};

Smoothed smoothed(const MeshDocument& document, PipelineOptions options = {}) {
  options.input = "mesh.vtu";
  options.smoothing.threads = options.smoothing.threads == 0 ? 1 : options.smoothing.threads;
  options.output = "smoothed.vtu";
  trismooth::DocumentMesh mesh(options);
  mesh.take(document);
  trismooth::StagedRun(mesh).check_and_smooth();
  trismooth::RunState& run = mesh.state();
  return {document, std::move(run.document), std::move(run.result)};
}

std::vector<Point> in_plane(const MeshDocument& document) {
  std::vector<Point> points;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    points.push_back({document.points[3 * v], document.points[3 * v + 1]});
  }
  return points;
}

/// The linear rule, element by element: see the never-worse check.
void check_never_worse(const Smoothed& run, const std::vector<Triangle>& triangles) {
  const std::vector<Point> before = in_plane(run.before);
  const std::vector<Point> after = in_plane(run.after);
  const double threshold = naive::touched_minimum(triangles, before, after);
  for (const Triangle& t : triangles) {
    REQUIRE_FALSE(naive::offends(naive::element_quotient(before, t), naive::element_quotient(after, t), threshold));
  }
}

void check_places(const Smoothed& run) {
  REQUIRE(run.result.coordinates_hash == trismooth::coordinates_hash(run.after.points));
  for (std::size_t v = 0; v < run.before.point_count(); ++v) {
    REQUIRE(same_bits(run.after.points[3 * v + 2], 2.5));
  }
}

PipelineOptions with(Method method, bool guard = true) {
  PipelineOptions options;
  options.smoothing.method = method;
  options.smoothing.guard = guard;
  options.smoothing.max_sweeps = 40;
  return options;
}

TEST_CASE("straight triangles of six nodes are smoothed as those of their corners are, counted and judged") {
  for (const Method method : {Method::smart, Method::mean_ratio}) {
    const Mesh mesh = test_meshes::jittered_grid(17, 13, 0.35, 7);
    const Smoothed plain = smoothed(triangle_document(mesh, 2.5), with(method));
    const Smoothed straight = smoothed(quadratic(mesh, 0, 1), with(method));
    const std::size_t numbers = 3 * mesh.points.size();
    CHECK(same_bits(std::span(plain.after.points).first(numbers), std::span(straight.after.points).first(numbers)));
    CHECK(straight.result.smoothing->moved_vertices == plain.result.smoothing->moved_vertices);
    CHECK(straight.result.smoothing->moved_vertices > 100);
    CHECK(straight.result.input.free_vertices == plain.result.input.free_vertices);
    CHECK(straight.result.input.fixed_vertices == plain.result.input.fixed_vertices);
    CHECK(straight.result.input.held.unused == 0);
    CHECK(straight.result.input.held.other_cells == 0);
    CHECK(straight.result.input.quadratic_triangles == std::ssize(mesh.triangles));
    CHECK(straight.result.input.middle_nodes == std::ssize(straight.before.points) / 3 - mesh.vertex_count());
    CHECK(straight.result.quadratic_after->invalid == 0);
    CHECK(straight.result.quadratic_after->min_jacobian == Approx(1).epsilon(1e-9));
    check_places(straight);
  }
}

TEST_CASE("curved meshes never get worse: valid elements stay valid, by samples of the Jacobian") {
  int lost_without_guard = 0;
  std::int64_t put_back = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    CAPTURE(seed);
    const Method method = std::array{Method::smart, Method::laplacian, Method::mean_ratio}[seed % 3];
    const Mesh mesh = test_meshes::jittered_grid(11, 9, 0.3, seed);
    const MeshDocument document = quadratic(mesh, 0.02 + 0.01 * static_cast<double>(seed % 12), seed);
    const Smoothed guarded = smoothed(document, with(method));
    const Smoothed loose = smoothed(document, with(method, false));
    check_never_worse(guarded, mesh.triangles);
    check_places(guarded);
    CHECK(guarded.result.quadratic_after->invalid <= guarded.result.quadratic_before->invalid);
    put_back += guarded.result.smoothing->reverted_vertices;
    for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
      const auto nodes = document.cells[c];
      const auto at = [&](const MeshDocument& of, std::size_t node, std::size_t axis) {
        return of.points[3 * static_cast<std::size_t>(nodes[node]) + axis];
      };
      const auto smallest = [&](const MeshDocument& of) {
        return smallest_jacobian_sample([&](std::size_t node, std::size_t axis) { return at(of, node, axis); });
      };
      // Well above what the smallest value may be below these samples.
      if (smallest(document) > 2e-4) {
        lost_without_guard += smallest(loose.after) > 0 ? 0 : 1;
        REQUIRE(smallest(guarded.after) > 0);
      }
      // A middle goes where its side's ends go, at the fraction of the side at which its foot was.
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        double along = 0;
        double length = 0;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double side = at(document, b, axis) - at(document, a, axis);
          along += side * (at(document, 3 + a, axis) - at(document, a, axis));
          length += side * side;
        }
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const auto move = [&](std::size_t node) { return at(guarded.after, node, axis) - at(document, node, axis); };
          REQUIRE(std::abs(move(3 + a) - (move(a) + along / length * (move(b) - move(a)))) <= 1e-15);
          REQUIRE((move(a) != 0 || move(b) != 0 || move(3 + a) == 0));
        }
      }
    }
  }
  CHECK(lost_without_guard > 0);
  CHECK(put_back > 0);
}

TEST_CASE("curved results are the same for every number of threads") {
  const MeshDocument document = quadratic(test_meshes::jittered_grid(120, 90, 0.3, 5), 0.08, 5);
  PipelineOptions options = with(Method::smart);
  options.smoothing.threads = 1;
  const Smoothed one = smoothed(document, options);
  options.smoothing.threads = 4;
  const Smoothed four = smoothed(document, options);
  CHECK(same_bits(one.after.points, four.after.points));
  CHECK(one.result.smoothing->guard_rounds == four.result.smoothing->guard_rounds);
  CHECK(one.result.unguarded_hash == four.result.unguarded_hash);
}

TEST_CASE("a middle that is named stays with its side's ends") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.3, 3);
  MeshDocument document = quadratic(mesh, 0, 1);
  std::vector<std::uint8_t> fixed(document.point_count(), 0);
  const std::int32_t inner = 4 * 9 + 4;
  std::size_t cell = 0;
  while (mesh.triangles[cell][0] != inner) {
    ++cell;
  }
  const std::int32_t middle = document.cells[cell][3];
  fixed[static_cast<std::size_t>(middle)] = 1;
  document.point_arrays.push_back(make_data_array("fixed", 1, fixed));
  const Smoothed run = smoothed(document, with(Method::smart));
  for (const std::int32_t v : {middle, inner, mesh.triangles[cell][1]}) {
    const std::size_t i = 3 * static_cast<std::size_t>(v);
    CHECK(same_bits(std::span(run.after.points).subspan(i, 3), std::span(run.before.points).subspan(i, 3)));
  }
  CHECK(run.result.input.held.named == 3);
}

TEST_CASE("fields at middles follow the mesh as those at corners do") {
  MeshDocument document = quadratic(test_meshes::jittered_grid(13, 11, 0.3, 9), 0.03, 9);
  document.format = trismooth::FileFormat::vtk;
  std::vector<double> values;
  for (const Point p : in_plane(document)) {
    values.push_back(3 * p.x - 2 * p.y + 1);
  }
  document.point_arrays.push_back(make_data_array("depth", 1, values));
  document.arrays_of_places = {"depth"};
  PipelineOptions options = with(Method::smart);
  options.output = "out.vtk";
  const Smoothed run = smoothed(document, options);
  const std::vector<Point> now = in_plane(run.after);
  std::int64_t changed = 0;
  for (std::size_t v = 0; v < now.size(); ++v) {
    REQUIRE(run.after.point_arrays[0].value(v) == Approx(3 * now[v].x - 2 * now[v].y + 1).margin(1e-12));
    changed += run.after.point_arrays[0].value(v) != values[v] ? 1 : 0;
  }
  CHECK(changed > 250);
}

TEST_CASE("what a file of few characters holds is what is judged") {
  for (const std::size_t characters : {5U, 6U, 8U, 12U}) {
    for (const Method method : {Method::smart, Method::laplacian}) {
      const Mesh mesh = test_meshes::jittered_grid(13, 11, 0.45, characters);
      MeshDocument document = triangle_document(mesh, 2.5);
      document.most_coordinate_characters = characters;
      const Smoothed run = smoothed(document, with(method));
      check_never_worse(run, mesh.triangles);
      check_places(run);
      std::int64_t moved = 0;
      for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        bool has_moved = false;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double now = run.after.points[3 * v + axis];
          if (!same_bits(now, document.points[3 * v + axis])) {
            has_moved = true;
            REQUIRE(same_bits(now, trismooth::rounded_to_characters(now, characters)));
          }
        }
        moved += has_moved ? 1 : 0;
      }
      CAPTURE(characters);
      CHECK(moved == run.result.smoothing->moved_vertices);
      CHECK(moved > 20);
    }
  }
}

TEST_CASE("turned components are as they were read or as they were turned, also where few characters are stored") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh mesh = test_meshes::tangled(9, seed);
    MeshDocument document = triangle_document(mesh, 2.5);
    document.most_coordinate_characters = 7;
    PipelineOptions options = with(Method::mean_ratio);
    options.smoothing.untangle = trismooth::Untangle::on;
    const Smoothed run = smoothed(document, options);
    CAPTURE(seed);
    CHECK(run.result.after->inverted <= run.result.before.inverted);
    REQUIRE(run.result.smoothing->untangling);
    CHECK(run.result.smoothing->untangling->inverted_after <= run.result.smoothing->untangling->inverted_before);
  }
}

}  // namespace trismooth::stored_result_test
