// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/test_meshes.h"

/// Smoothing a mesh and comparing what came of it, for tests that hold a device to the CPU.
namespace smoothing_runs {

using namespace trismooth;
using test_meshes::Mesh;

inline constexpr auto forms = {Form::swap, Form::in_place};
inline constexpr auto precisions = {Precision::double_precision, Precision::single_precision};

/// Coordinates after smoothing, and what was said of it.
struct Run {
  std::vector<double> xy;
  SmoothingResult result;
};

/// Smooths the mesh's own coordinates.
inline Run run(const Mesh& mesh, const SmoothingOptions& options, const Constraints& constraints = {},
               Storage storage = Storage::float64) {
  Run run{mesh.xy(), {}};
  run.result = plan(mesh.vertex_count(), mesh.indices(), constraints, options).smooth(run.xy, storage);
  return run;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// Equal, or both no numbers.
inline bool same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// The same bits, and the same in all that results say alike on every backend.
inline void require_same(const Run& found, const Run& expected) {
  REQUIRE(same_bits(found.xy, expected.xy));
  REQUIRE(found.result.sweeps == expected.result.sweeps);
  REQUIRE(found.result.stop_reason == expected.result.stop_reason);
  REQUIRE(found.result.moved_vertices == expected.result.moved_vertices);
  REQUIRE(found.result.guard_rounds == expected.result.guard_rounds);
  REQUIRE(found.result.free_vertices == expected.result.free_vertices);
  REQUIRE(found.result.reverted_vertices == expected.result.reverted_vertices);
  REQUIRE(found.result.reverted.size() == expected.result.reverted.size());
  for (std::size_t i = 0; i < found.result.reverted.size(); ++i) {
    REQUIRE(found.result.reverted[i].vertex == expected.result.reverted[i].vertex);
    REQUIRE(found.result.reverted[i].position == expected.result.reverted[i].position);
  }
  REQUIRE(found.result.history.size() == expected.result.history.size());
  for (std::size_t i = 0; i < found.result.history.size(); ++i) {
    CAPTURE(i);
    REQUIRE(found.result.history[i].sweep == expected.result.history[i].sweep);
    REQUIRE(found.result.history[i].moved == expected.result.history[i].moved);
    REQUIRE(found.result.history[i].max_relative_move == expected.result.history[i].max_relative_move);
    REQUIRE(same_number(found.result.history[i].min_shape, expected.result.history[i].min_shape));
  }
}

}  // namespace smoothing_runs
