// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/cuda/devices.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "smoothing_runs.h"
#include "support/mixed_meshes.h"

/// Meshes with quadrilaterals and ways to smooth them, for tests that hold a device to the CPU.
namespace mixed_runs {

using namespace trismooth;
using mixed_meshes::MixedMesh;
using smoothing_runs::forms;
using smoothing_runs::precisions;
using smoothing_runs::require_same;
using smoothing_runs::Run;

inline constexpr auto methods = trismooth::values_of<Method>();

inline Run run(const MixedMesh& mesh, const SmoothingOptions& options, const Constraints& constraints = {},
               Storage storage = Storage::float64) {
  Run run{mesh.xy(), {}};
  run.result = plan(mesh.vertex_count(), mesh.elements, constraints, options).smooth(run.xy, storage);
  return run;
}

inline void require_of_device(const Run& found, const Run& expected) {
  REQUIRE(found.result.backend == "cuda");
  REQUIRE(found.result.device == cuda::survey_devices().devices.front().name);
  REQUIRE((found.result.kernel_launches > 0) == (expected.result.free_vertices > 0));
  REQUIRE(found.result.colours == expected.result.colours);
  REQUIRE(found.result.quadrilaterals == expected.result.quadrilaterals);
  REQUIRE(found.result.layers.kept == expected.result.layers.kept);
  REQUIRE(found.result.inverted == expected.result.inverted);
  REQUIRE(found.result.degenerate == expected.result.degenerate);
  require_same(found, expected);
}

/// Every method, with what else the mean-ratio method may aim at and do, in both forms and precisions.
inline std::vector<SmoothingOptions> all_ways(std::int64_t max_sweeps) {
  std::vector<SmoothingOptions> of_methods;
  for (const Method method : methods) {
    of_methods.emplace_back().method = method;
  }
  for (const TargetShape target : {TargetShape::uniform, TargetShape::input}) {
    SmoothingOptions& options = of_methods.emplace_back();
    options.method = Method::mean_ratio;
    options.mean_ratio = {2.5, 5, target};
  }
  of_methods.emplace_back().method = Method::mean_ratio;
  of_methods.back().mean_ratio.steady = true;
  std::vector<SmoothingOptions> ways;
  for (SmoothingOptions options : of_methods) {
    options.max_sweeps = max_sweeps;
    options.untangle = Untangle::off;  // tangled meshes would go to the host
    for (const Form form : forms) {
      for (const Precision precision : precisions) {
        options.form = form;
        options.precision = precision;
        ways.push_back(options);
      }
    }
  }
  return ways;
}

inline std::string name_of(const SmoothingOptions& options) {
  return std::string(to_string(options.method)) + ", form " + std::string(to_string(options.form)) + ", " +
         std::string(to_string(options.precision)) + ", " + std::string(to_string(options.mean_ratio.target)) +
         (options.mean_ratio.steady ? ", steady" : "");
}

/// Random meshes, all with quadrilaterals.
inline std::vector<MixedMesh> random_meshes(std::size_t count) {
  std::vector<MixedMesh> meshes;
  for (std::uint64_t seed = 0; meshes.size() < count; ++seed) {
    MixedMesh mesh = mixed_meshes::random_mesh(seed);
    if (!std::ranges::all_of(mesh.elements, [](const auto& element) { return element[3] == no_corner; })) {
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

/// Rows that grow away from a wall.
inline MixedMesh with_layers() {
  MixedMesh mesh(40, 20, 0.3, 6, 0);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto row = static_cast<int>(v / 41);
    auto& [x, y] = mesh.points[v];
    x = row <= 8 ? static_cast<double>(v % 41) : x;
    y = row <= 8 ? 0.01 * (std::pow(1.6, row) - 1) / 0.6 : y + 0.01 * (std::pow(1.6, 8) - 1) / 0.6 - 8;
  }
  return mesh;
}

}  // namespace mixed_runs
