// SPDX-License-Identifier: BSD-3-Clause
// The CUDA backend against the CPU's, in all that results say: bits, stop reasons, histories, what the guard took
// back.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/rounding.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/keep_never_worse.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "cpu_comparison.h"
#include "support/test_meshes.h"

using namespace trismooth;
using namespace cpu_comparison;
using test_meshes::Mesh;

namespace {

constexpr auto methods = trismooth::values_of<Method>();

}  // namespace

TEST_CASE("every kind of mesh has the CPU's bits, history and guard in every execution and layout") {
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    for (const Method method : methods) {
      for (const Form form : forms) {
        for (const Precision precision : precisions) {
          // Measuring the shape takes the resident execution to other kernels.
          for (const bool measures : {true, false}) {
            CAPTURE(to_string(method), to_string(form), to_string(precision), measures);
            SmoothingOptions options;
            options.method = method;
            options.form = form;
            options.precision = precision;
            options.max_sweeps = 60;
            options.record_min_shape = measures;
            options.untangle = Untangle::off;  // tangled meshes would go to the host
            require_cpu_results(mesh, options);
          }
        }
      }
    }
  }
}

TEST_CASE("the resident execution evaluates the vertices that the CPU evaluates, and those alone") {
  const Mesh mesh = test_meshes::jittered_grid(40, 30, 0.45, 3);
  for (const Form form : forms) {
    for (const Evaluation evaluation : {Evaluation::changed, Evaluation::all}) {
      SmoothingOptions options;
      options.form = form;
      options.evaluation = evaluation;
      const Run expected = run(mesh, options);
      options.backend = &cuda::backend();
      const Run found = run(mesh, options);
      require_same(found, expected);
      CHECK(found.result.vertex_updates == expected.result.vertex_updates);
      for (std::size_t i = 0; i < found.result.history.size(); ++i) {
        CHECK(found.result.history[i].evaluated == expected.result.history[i].evaluated);
      }
    }
  }
}

TEST_CASE("a mesh that fills the whole device has the CPU's bits in both forms, whoever watches") {
  // Large enough for sweeps over all vertices, which come before those over changed ones.
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(900, 700, 0.45, 3), 4);
  for (const Form form : forms) {
    CAPTURE(to_string(form));
    SmoothingOptions options;
    options.form = form;
    const Run expected = run(mesh, options);
    options.backend = &cuda::backend();
    options.topology = Topology::device;
    require_same(run(mesh, options), expected);
    SmoothingOptions watched = options;
    watched.progress = [](const SweepRecord& /*record*/) { return Progress::proceed; };
    require_same(run(mesh, watched), expected);
    SmoothingOptions timed = options;
    timed.time_limit_seconds = 1e6;
    require_same(run(mesh, timed), expected);
  }
}

TEST_CASE("constraints hold the same vertices") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::tangled(20, 7), 2);
  std::vector<std::uint8_t> fixed(mesh.points.size());
  std::vector<std::uint8_t> other_cells(mesh.points.size());
  std::vector<std::int32_t> regions(mesh.triangles.size());
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    fixed[v] = v % 17 == 0 ? 1 : 0;
    other_cells[v] = v % 23 == 1 ? 1 : 0;
  }
  for (std::size_t t = 0; t < regions.size(); ++t) {
    regions[t] = static_cast<std::int32_t>(t % 9 / 8);
  }
  const std::vector<std::int32_t> ids{40, 41, 3};
  for (const Form form : forms) {
    SmoothingOptions options;
    options.form = form;
    options.method = Method::laplacian;
    require_cpu_results(mesh, options,
                        {.fixed = fixed, .fixed_ids = ids, .other_cells = other_cells, .regions = regions});
  }
}

TEST_CASE("mixed orientation, far offsets and extreme scales have the CPU's bits") {
  for (const double scale : {1.0, 1e-9, 1e200}) {
    for (const double offset : {0.0, 4e7}) {
      Mesh mesh = test_meshes::partly_reversed(test_meshes::jittered_grid(9, 11, 0.4, 8), 3);
      for (auto& p : mesh.points) {
        p = {(p.x + offset) * scale, (p.y - offset) * scale};
      }
      CAPTURE(scale, offset);
      require_cpu_results(mesh, {});
    }
  }
}

TEST_CASE("results stored as float32 are rounded before they are judged") {
  Mesh mesh = test_meshes::shuffled(test_meshes::tangled(16, 4), 5);
  for (auto& p : mesh.points) {
    p = {rounded_to_float32(p.x + 100), rounded_to_float32(p.y + 100)};
  }
  require_cpu_results(mesh, {}, {}, Storage::float32);
}

TEST_CASE("every reason to stop is the CPU's, at the same sweep") {
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.45, 6);
  SECTION("sweep limits, beyond what one launch records too") {
    for (const std::int64_t limit : {1, 2, 7, 256, 257, 600}) {
      SmoothingOptions options;
      options.method = Method::laplacian;
      options.tolerance = 0;
      options.max_sweeps = limit;
      const Run expected = run(mesh, options);
      options.backend = &cuda::backend();
      for (const Execution execution : built_executions()) {
        options.execution = execution;
        require_same(run(mesh, options), expected);
      }
    }
  }
  SECTION("tolerances") {
    for (const double tolerance : {1e-1, 1e-3, 0.0}) {
      SmoothingOptions options;
      options.tolerance = tolerance;
      require_cpu_results(mesh, options);
    }
  }
  SECTION("a quality target: met at once, met on the way, never met") {
    for (const double target : {-1.0, 0.05, 0.3, 1.0}) {
      for (const Form form : forms) {
        SmoothingOptions options;
        options.form = form;
        options.target_quality = target;
        CAPTURE(target);
        require_cpu_results(mesh, options);
      }
    }
  }
  SECTION("no time") {
    SmoothingOptions options;
    options.time_limit_seconds = 0;
    require_cpu_results(mesh, options);
  }
  SECTION("cancelled by the caller") {
    // Inside the first batch of records, at its end, after it.
    for (const std::int64_t last : {1, 3, 23, 24, 25, 40}) {
      SmoothingOptions options;
      options.tolerance = 0;
      options.progress = [last](const SweepRecord& record) {
        return record.sweep == last ? Progress::stop : Progress::proceed;
      };
      require_cpu_results(mesh, options);
    }
  }
}

TEST_CASE("whenever a call is over before its end the mesh is nowhere worse, and its plan as if it had not been") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(400, 400, 0.45, 6), 3);
  const std::vector<double> before = mesh.xy();
  for (const Method method : {Method::smart, Method::mean_ratio}) {
    SmoothingOptions options = on_cuda(Execution::resident);
    options.method = method;
    options.tolerance = 0;
    options.max_sweeps = 200;
    const Run whole = run(mesh, options);
    auto end = std::chrono::steady_clock::time_point::max();
    options.cancel = [&end] { return std::chrono::steady_clock::now() >= end; };
    SmoothingPlan made = plan(mesh.vertex_count(), mesh.indices(), options);
    for (const int microseconds : {0, 300, 1000, 3000, 10000, 30000}) {
      CAPTURE(method, microseconds);
      end = std::chrono::steady_clock::now() + std::chrono::microseconds(microseconds);
      std::vector<double> xy = mesh.xy();
      const SmoothingResult result = made.smooth(xy);
      CHECK((result.stop_reason == StopReason::cancelled) == (result.sweeps < whole.result.sweeps));
      CHECK(keep_never_worse(xy_points(before), xy_points(xy), mesh.indices()).reverted.empty());
      end = std::chrono::steady_clock::time_point::max();
      xy = mesh.xy();
      made.smooth(xy);
      CHECK(xy == whole.xy);
    }
  }
}

TEST_CASE("who stops sweeps that go to and fro for ever has the positions of that sweep") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.2, 66);
  for (const std::int64_t last : {299, 300, 997, 1000}) {
    SmoothingOptions options;
    options.method = Method::laplacian;
    options.form = Form::swap;
    options.precision = Precision::single_precision;
    options.tolerance = 0;
    options.progress = [last](const SweepRecord& record) {
      return record.sweep == last ? Progress::stop : Progress::proceed;
    };
    require_cpu_results(mesh, options);
  }
}

TEST_CASE("a callback that only watches costs a few launches, not one a sweep") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(60, 60, 0.45, 6), 3);
  SmoothingOptions options = on_cuda(Execution::resident);
  options.tolerance = 0;
  const Run alone = run(mesh, options);
  options.progress = [](const SweepRecord& /*record*/) { return Progress::proceed; };
  const Run watched = run(mesh, options);
  require_same(watched, alone);
  REQUIRE(alone.result.sweeps > 20);
  CHECK(watched.result.kernel_launches <= alone.result.kernel_launches + 10);
}

TEST_CASE("the callback hears of every sweep in order") {
  const Mesh mesh = test_meshes::jittered_grid(15, 15, 0.45, 6);
  for (const Execution execution : built_executions()) {
    SmoothingOptions options = on_cuda(execution);
    std::vector<std::int64_t> heard;
    options.progress = [&heard](const SweepRecord& record) {
      heard.push_back(record.sweep);
      return Progress::proceed;
    };
    const Run found = run(mesh, options);
    REQUIRE(static_cast<std::int64_t>(heard.size()) == found.result.sweeps);
    for (std::size_t i = 0; i < heard.size(); ++i) {
      CHECK(heard[i] == static_cast<std::int64_t>(i) + 1);
    }
  }
}

TEST_CASE("without the guard nothing is taken back") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::annulus(11, 6, 0.5), 8);
  SmoothingOptions options;
  options.method = Method::laplacian;
  options.guard = false;
  require_cpu_results(mesh, options);
}

TEST_CASE("the report names the device and counts launches, those of the device apart") {
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.45, 6);
  for (const Execution execution : built_executions()) {
    for (const Form form : forms) {
      SmoothingOptions options = on_cuda(execution);
      options.form = form;
      const SmoothingResult result = run(mesh, options).result;
      CHECK(result.backend == "cuda");
      CHECK(result.device == cuda::survey_devices().devices.front().name);
      CHECK(result.kernel_launches > 0);
      CHECK(result.device_memory_bytes > 0);
      CHECK(result.reproducible);
      const std::int64_t passes = form == Form::swap ? result.sweeps : result.sweeps * result.colours;
      CHECK(result.child_launches == (execution == Execution::cdp ? 2 * passes : 0));
    }
  }
}

TEST_CASE("unordered updates keep the contract and say that they are not reproducible") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(30, 30, 0.45, 6), 3);
  const std::vector<double> before = mesh.xy();
  for (const device_ways::DeviceWay& way : device_ways::paper_ways()) {
    SmoothingOptions options = on_cuda();
    way.choose_in(options);
    options.order = Order::unordered;
    const Run found = run(mesh, options);
    CHECK_FALSE(found.result.reproducible);
    CHECK(found.result.colours == 0);
    CHECK(found.result.moved_vertices > 0);
    for (const double x : found.xy) {
      REQUIRE(std::isfinite(x));
    }
    double worst_before = 1;
    double worst_after = 1;
    for (const Triangle& t : mesh.triangles) {
      const auto shape_in = [&](const std::vector<double>& xy) {
        const auto at = [&](std::int32_t v) { return Point2<double>{xy[2 * v], xy[2 * v + 1]}; };
        return shape(at(t[0]), at(t[1]), at(t[2]));
      };
      worst_before = std::min(worst_before, shape_in(before));
      worst_after = std::min(worst_after, shape_in(found.xy));
    }
    CHECK(worst_after >= worst_before);
  }
  SmoothingOptions options = on_cuda();
  options.order = Order::unordered;
  CHECK_THROWS_AS(run(mesh, options), std::invalid_argument);
}
