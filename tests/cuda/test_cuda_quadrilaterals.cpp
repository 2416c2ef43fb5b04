// SPDX-License-Identifier: BSD-3-Clause
// Meshes with quadrilaterals on the device against the CPU, in all that results say.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/rounding.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/packing/colouring.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "mixed_runs.h"
#include "smoothing_runs.h"
#include "support/hostile_meshes.h"
#include "support/mixed_meshes.h"
#include "support/refusal.h"

using namespace trismooth;
using mixed_meshes::MixedMesh;
using mixed_runs::all_ways;
using mixed_runs::methods;
using mixed_runs::name_of;
using mixed_runs::random_meshes;
using mixed_runs::require_of_device;
using mixed_runs::run;
using mixed_runs::with_layers;
using smoothing_runs::forms;
using smoothing_runs::precisions;
using smoothing_runs::require_same;
using smoothing_runs::Run;
using test_support::refusal;

namespace {

/// What the CPU made of it.
Run require_cpu_results(const MixedMesh& mesh, SmoothingOptions options, const Constraints& constraints = {},
                        Storage storage = Storage::float64) {
  options.untangle = Untangle::off;  // tangled meshes would go to the host
  const Run expected = run(mesh, options, constraints, storage);
  options.backend = &cuda::backend();
  require_of_device(run(mesh, options, constraints, storage), expected);
  return expected;
}

/// A grid of squares and triangles with such vertices in it as a grid has not: one between two quadrilaterals alone,
/// which has two neighbours, and hubs of `spokes` quadrilaterals and of as many triangles.
MixedMesh with_odd_vertices(std::int32_t spokes) {
  MixedMesh mesh(14, 12, 0.2, 5);
  const auto between = static_cast<std::int32_t>(mesh.points.size());
  const auto first = std::ranges::find_if(mesh.elements, [](const auto& e) { return e[3] >= 0 && e[0] > 30; });
  const auto [a, b, c, d] = *first;
  const auto middle = [&](std::int32_t from, std::int32_t to) {
    return mixed_meshes::Point{0.5 * (mesh.points[from][0] + mesh.points[to][0]) + 0.05,
                               0.5 * (mesh.points[from][1] + mesh.points[to][1])};
  };
  mesh.points.push_back(middle(a, c));
  *first = {a, b, c, between};
  mesh.elements.push_back({a, between, c, d});
  for (const bool is_of_triangles : {false, true}) {
    const double x0 = is_of_triangles ? 40 : 25;
    const auto hub = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back({x0 + 0.3, 0.4});
    // Two rims of which the inner one is free.
    const std::int32_t count = is_of_triangles ? spokes : 2 * spokes;
    for (const double radius : {2.0, 3.5}) {
      for (std::int32_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count + (radius == 2.0 ? 0.3 / count : 0);
        mesh.points.push_back({x0 + radius * std::cos(angle), radius * std::sin(angle)});
      }
    }
    const auto inner = [&](std::int32_t i) { return hub + 1 + i % count; };
    const auto outer = [&](std::int32_t i) { return hub + 1 + count + i % count; };
    for (std::int32_t i = 0; i < count; ++i) {
      mesh.elements.push_back({inner(i), outer(i), outer(i + 1), inner(i + 1)});
      if (is_of_triangles) {
        mesh.elements.push_back({hub, inner(i), inner(i + 1), -1});
      } else if (i % 2 == 0) {
        mesh.elements.push_back({hub, inner(i), inner(i + 1), inner(i + 2)});
      }
    }
  }
  return mesh;
}

/// Colours on both sides; answers the rounds on the device.
int check_colours(std::int32_t vertices, std::span<const MixedElement> elements) {
  Workers workers(0);
  const auto topology = connect_triangles(vertices, elements, workers);
  const OneRings rings = one_rings(topology, elements, topology.parity, topology.hold, workers);
  const Colouring expected = colour_free_vertices(rings.view(), workers);
  cuda::Context context;
  const std::vector<std::uint32_t> offsets(rings.offsets.begin(), rings.offsets.end());
  const cuda::DeviceRings on_device{{context, offsets}, {context, rings.neighbours}, {context, rings.opposites}};
  REQUIRE(on_device.has_quadrilaterals() == !rings.neighbours.empty());
  const cuda::DeviceColouring colouring = cuda::colour_vertices(context, on_device.mixed_view());
  CHECK(colouring.count == expected.count);
  CHECK(cuda::download(context, colouring.colours.data(), colouring.colours.size()) == expected.colours);
  return colouring.rounds;
}

}  // namespace

TEST_CASE("random meshes with quadrilaterals have the CPU's bits, history and guard by every method") {
  std::int64_t reverted = 0;
  std::int64_t quadrilaterals = 0;
  for (const MixedMesh& mesh : random_meshes(30)) {
    for (SmoothingOptions options : all_ways(20)) {
      // Measuring the shape, and evaluating all, take the run to other kernels.
      for (const auto& [measures, evaluation] :
           {std::pair(false, Evaluation::changed), std::pair(true, Evaluation::changed),
            std::pair(false, Evaluation::all)}) {
        CAPTURE(mesh.points.front()[0], name_of(options), measures, to_string(evaluation));
        options.record_min_shape = measures;
        options.evaluation = evaluation;
        const Run expected = require_cpu_results(mesh, options);
        reverted += expected.result.reverted_vertices;
        quadrilaterals += expected.result.quadrilaterals;
      }
    }
  }
  CHECK(reverted > 100);
  CHECK(quadrilaterals > 10000);
}

TEST_CASE("large meshes of quadrilaterals, and of both kinds, have the CPU's bits to their stop") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    const MixedMesh mesh(160, 150, 0.4, 3, thirds);
    for (const SmoothingOptions& options : all_ways(400)) {
      CAPTURE(thirds, name_of(options));
      require_cpu_results(mesh, options);
    }
  }
}

TEST_CASE("a mesh of quadrilaterals that fills the whole device has the CPU's bits, whoever watches") {
  // Large enough for sweeps over all vertices, which come before those over changed ones.
  for (const auto& [columns, form] : {std::pair(760, Form::swap), std::pair(1700, Form::in_place)}) {
    const MixedMesh mesh(columns, columns, 0.3, 3, 1);
    CAPTURE(to_string(form));
    SmoothingOptions options;
    options.form = form;
    options.precision = Precision::single_precision;
    options.max_sweeps = 24;
    const Run expected = require_cpu_results(mesh, options);
    options.backend = &cuda::backend();
    options.progress = [](const SweepRecord& /*record*/) { return Progress::proceed; };
    require_of_device(run(mesh, options), expected);
  }
}

TEST_CASE("the device evaluates the vertices among quadrilaterals that the CPU evaluates, and those alone") {
  const MixedMesh mesh(40, 30, 0.45, 3);
  for (const Method method : {Method::smart, Method::laplacian, Method::weighted}) {
    for (const Form form : forms) {
      for (const Evaluation evaluation : {Evaluation::changed, Evaluation::all}) {
        SmoothingOptions options;
        options.method = method;
        options.form = form;
        options.evaluation = evaluation;
        options.max_sweeps = 60;
        const Run expected = run(mesh, options);
        options.backend = &cuda::backend();
        const Run found = run(mesh, options);
        require_of_device(found, expected);
        CHECK(found.result.vertex_updates == expected.result.vertex_updates);
        for (std::size_t i = 0; i < found.result.history.size(); ++i) {
          CHECK(found.result.history[i].evaluated == expected.result.history[i].evaluated);
        }
      }
    }
  }
}

TEST_CASE("rings of quadrilaterals of two neighbours, and of very many, have the CPU's bits") {
  for (const std::int32_t spokes : {5, 9, 40, 3000}) {
    const MixedMesh mesh = with_odd_vertices(spokes);
    for (SmoothingOptions options : all_ways(15)) {
      CAPTURE(spokes, name_of(options));
      options.layers = Layers::smooth;
      const Run expected = require_cpu_results(mesh, options);
      CHECK(expected.result.free_vertices == 13 * 11 + 1 + 2 + 3 * spokes);
      CHECK(expected.result.moved_vertices > 0);
    }
  }
}

TEST_CASE("colours of meshes with quadrilaterals are the host's, in few rounds") {
  for (const MixedMesh& mesh : random_meshes(30)) {
    check_colours(mesh.vertex_count(), mesh.elements);
  }
  const MixedMesh large(300, 300, 0.3, 1, 1);
  CHECK(check_colours(large.vertex_count(), large.elements) < 30);
  const MixedMesh hubs = with_odd_vertices(20000);
  check_colours(hubs.vertex_count(), hubs.elements);
  // Of triangles but for four squares, and against the order: the host does the rest.
  for (const std::int32_t length : {10, 1000, 100000}) {
    const test_meshes::Mesh chain = hostile_meshes::chain(length);
    std::vector<MixedElement> elements;
    for (const auto& [a, b, c] : chain.triangles) {
      elements.push_back({a, b, c, no_corner});
    }
    const std::int32_t first = chain.vertex_count();
    for (const auto& [a, b, c, d] : MixedMesh(2, 2, 0, 1, 0).elements) {
      elements.push_back({first + a, first + b, first + c, first + d});
    }
    CAPTURE(length);
    CHECK(check_colours(first + 9, elements) <= cuda::DeviceColouring::most_rounds);
  }
}

TEST_CASE("what the guard takes back of quadrilaterals is what the CPU's takes back, however much it is") {
  // Bent so that means of neighbours lie outside.
  MixedMesh mesh(500, 400, 0.45, 8, 1);
  for (auto& [x, y] : mesh.points) {
    y = 0.02 * y + 3 * std::sin(x);
  }
  SmoothingOptions options;
  options.method = Method::laplacian;
  options.layers = Layers::smooth;
  options.max_sweeps = 4;
  std::int64_t most = 0;
  std::int64_t rounds = 0;
  for (const Form form : forms) {
    for (const Precision precision : precisions) {
      CAPTURE(to_string(form), to_string(precision));
      options.form = form;
      options.precision = precision;
      const Run expected = require_cpu_results(mesh, options);
      most = std::max(most, expected.result.reverted_vertices);
      rounds = std::max(rounds, expected.result.guard_rounds);
    }
  }
  // More than the device has room for at first.
  CHECK(most > 200'000 / 32);
  CHECK(rounds > 2);
  options.guard = false;
  require_cpu_results(mesh, options);
}

TEST_CASE("quadrilaterals stored as float32 are rounded before they are judged") {
  for (MixedMesh mesh : random_meshes(20)) {
    for (auto& [x, y] : mesh.points) {
      x = rounded_to_float32(x + 100);
      y = rounded_to_float32(y + 100);
    }
    for (const Method method : methods) {
      CAPTURE(mesh.points.front()[0], to_string(method));
      SmoothingOptions options;
      options.method = method;
      options.max_sweeps = 30;
      require_cpu_results(mesh, options, {}, Storage::float32);
    }
  }
}

TEST_CASE("plans of quadrilaterals have the CPU's bits in every call, whatever the points are by then") {
  const MixedMesh mesh(30, 25, 0.4, 2);
  const std::vector<double> others = MixedMesh(30, 25, 0.3, 77).xy();
  for (SmoothingOptions options : all_ways(30)) {
    CAPTURE(name_of(options));
    SmoothingPlan on_cpu = plan(mesh.vertex_count(), mesh.elements, options);
    options.backend = &cuda::backend();
    SmoothingPlan on_device = plan(mesh.vertex_count(), mesh.elements, options);
    for (const std::vector<double>& points : {mesh.xy(), others, mesh.xy()}) {
      Run expected{points, {}};
      Run found{points, {}};
      expected.result = on_cpu.smooth(expected.xy);
      found.result = on_device.smooth(found.xy);
      require_of_device(found, expected);
    }
    CHECK(on_device.fixed() == on_cpu.fixed());
  }
}

TEST_CASE("vertices of quadrilaterals that are named, of regions and of layers are held as on the CPU") {
  const MixedMesh mesh = MixedMesh(30, 20, 0.35, 4).listed_from_other_corners(3, true);
  std::vector<std::uint8_t> fixed(mesh.points.size());
  std::vector<std::int32_t> regions(mesh.elements.size());
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    fixed[v] = v % 17 == 0 ? 1 : 0;
  }
  for (std::size_t e = 0; e < regions.size(); ++e) {
    regions[e] = static_cast<std::int32_t>(e % 9 / 8);
  }
  const std::vector<std::int32_t> ids{40, 41, 3};
  for (const SmoothingOptions& options : all_ways(40)) {
    CAPTURE(name_of(options));
    require_cpu_results(mesh, options, {.fixed = fixed, .fixed_ids = ids, .regions = regions});
  }
  const MixedMesh layered = with_layers();
  for (const Layers layers : {Layers::keep, Layers::smooth}) {
    SmoothingOptions options;
    options.method = Method::mean_ratio;
    options.layers = layers;
    const Run expected = require_cpu_results(layered, options);
    CHECK((expected.result.layers.kept > 100) == (layers == Layers::keep));
  }
}

TEST_CASE("sizes that are asked for of quadrilaterals are aimed at as on the CPU") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    const MixedMesh mesh(60, 50, 0.25, 3, thirds);
    std::vector<double> lengths;
    for (const auto& [x, y] : mesh.points) {
      lengths.push_back(0.5 + x / 40 + y / 100);
    }
    for (SmoothingOptions options : all_ways(60)) {
      if (options.method == Method::mean_ratio) {
        CAPTURE(thirds, name_of(options));
        options.mean_ratio.target_lengths = lengths;
        require_cpu_results(mesh, options);
      }
    }
  }
}

TEST_CASE("every reason to stop the sweeps over quadrilaterals is the CPU's, at the same sweep") {
  const MixedMesh mesh(24, 20, 0.4, 6);
  SECTION("sweep limits, beyond what one launch records too") {
    for (const std::int64_t limit : {1, 2, 7, 256, 257, 600}) {
      for (const Form form : forms) {
        SmoothingOptions options;
        options.method = Method::laplacian;
        options.form = form;
        options.tolerance = 0;
        options.max_sweeps = limit;
        require_cpu_results(mesh, options);
      }
    }
  }
  SECTION("tolerances") {
    for (const double tolerance : {1e-1, 1e-3, 0.0}) {
      for (const Method method : methods) {
        SmoothingOptions options;
        options.method = method;
        options.tolerance = tolerance;
        options.max_sweeps = 300;
        require_cpu_results(mesh, options);
      }
    }
  }
  SECTION("a quality target: met at once, met on the way, never met") {
    int at_once = 0;
    int on_the_way = 0;
    int never = 0;
    for (const double target : {-1.0, 0.05, 0.4, 1.0}) {
      for (const Form form : forms) {
        for (const Method method : methods) {
          CAPTURE(target, to_string(method));
          SmoothingOptions options;
          options.method = method;
          options.form = form;
          options.target_quality = target;
          options.max_sweeps = 100;
          const Run expected = require_cpu_results(mesh, options);
          const bool is_met = expected.result.stop_reason == StopReason::quality_target;
          at_once += is_met && expected.result.sweeps == 0 ? 1 : 0;
          on_the_way += is_met && expected.result.sweeps > 0 ? 1 : 0;
          never += is_met ? 0 : 1;
        }
      }
    }
    CHECK((at_once > 0 && on_the_way > 0 && never > 0));
  }
  SECTION("more time than enough, and none") {
    SmoothingOptions options;
    options.time_limit_seconds = 1e6;
    require_cpu_results(mesh, options);
    options.time_limit_seconds = 0;
    const Run expected = run(mesh, options);
    options.backend = &cuda::backend();
    require_same(run(mesh, options), expected);
  }
  SECTION("cancelled by the caller, who hears of every sweep and its smallest shape") {
    for (const std::int64_t last : {1, 3, 23, 24, 25, 40}) {
      for (const Method method : {Method::smart, Method::mean_ratio}) {
        SmoothingOptions options;
        options.method = method;
        options.tolerance = 0;
        options.max_sweeps = 60;
        options.record_min_shape = true;
        std::vector<double> heard;
        options.progress = [last, &heard](const SweepRecord& record) {
          heard.push_back(record.min_shape);
          return record.sweep == last ? Progress::stop : Progress::proceed;
        };
        const Run expected = require_cpu_results(mesh, options);
        // Once from the CPU, once from the device.
        const auto sweeps = static_cast<std::size_t>(expected.result.sweeps);
        REQUIRE(heard.size() == 2 * sweeps);
        CHECK(std::equal(heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(sweeps),
                         heard.begin() + static_cast<std::ptrdiff_t>(sweeps)));
      }
    }
  }
}

TEST_CASE("meshes without a free vertex, and far or tiny ones, of quadrilaterals have the CPU's bits") {
  for (const std::int32_t rows : {1, 2}) {
    const MixedMesh mesh(1, rows, 0.1, 3, 0);
    const Run expected = run(mesh, {});
    SmoothingOptions options;
    options.record_min_shape = true;
    options.backend = &cuda::backend();
    const Run found = run(mesh, options);
    CHECK(found.result.backend == "cuda");
    CHECK(found.result.free_vertices == 0);
    CHECK(found.xy == expected.xy);
  }
  for (const double scale : {1.0, 1e-9, 1e200}) {
    for (const double offset : {0.0, 4e7}) {
      MixedMesh mesh(9, 11, 0.3, 8);
      for (auto& [x, y] : mesh.points) {
        x = (x + offset) * scale;
        y = (y - offset) * scale;
      }
      CAPTURE(scale, offset);
      require_cpu_results(mesh, {});
    }
  }
}

TEST_CASE("tangled meshes of quadrilaterals have the CPU's bits, untangled, and the others are the device's") {
  int of_host = 0;
  int of_device = 0;
  std::vector<MixedMesh> meshes = random_meshes(20);
  for (const std::uint64_t thirds : {0U, 1U}) {
    meshes.emplace_back(20, 15, 0.2, 4, thirds);
    meshes.emplace_back(20, 15, 0.5, 4, thirds);
    // Mirrored inside: it is turned over.
    MixedMesh& turned = meshes.emplace_back(12, 12, 0.2, 4, thirds);
    for (std::size_t v = 0; v < turned.points.size(); ++v) {
      auto& [x, y] = turned.points[v];
      const std::size_t column = v % 13;
      const std::size_t row = v / 13;
      x = column % 12 == 0 || row % 12 == 0 ? x : 12 - x;
    }
  }
  for (const MixedMesh& mesh : meshes) {
    for (SmoothingOptions options : all_ways(15)) {
      CAPTURE(mesh.points.front()[0], name_of(options));
      options.untangle = Untangle::on;
      const Run expected = run(mesh, options);
      options.backend = &cuda::backend();
      const Run found = run(mesh, options);
      require_same(found, expected);
      REQUIRE(found.result.untangling);
      REQUIRE(expected.result.untangling);
      const UntanglingResult& here = *found.result.untangling;
      const UntanglingResult& there = *expected.result.untangling;
      CHECK(here.inverted_before == there.inverted_before);
      CHECK(here.inverted_untangled == there.inverted_untangled);
      CHECK(here.inverted_after == there.inverted_after);
      CHECK(here.inverted_fixed == there.inverted_fixed);
      CHECK(here.turned == there.turned);
      CHECK(found.result.inverted == expected.result.inverted);
      CHECK((found.result.backend == "cpu") == (there.inverted_before > 0));
      ++(found.result.backend == "cpu" ? of_host : of_device);
    }
  }
  CHECK(of_host > 100);
  CHECK(of_device > 30);
}

TEST_CASE("vertices of quadrilaterals slide along lines to the same bits on the device") {
  std::int64_t slid = 0;
  for (const MixedMesh& mesh : random_meshes(40)) {
    Constraints constraints;
    constraints.slide.along = mesh.elements.size() % 3 == 0 ? Slide::straight : Slide::curves;
    constraints.slide.deviation = 0.1;
    constraints.slide.corner_angle = 60;
    std::vector<std::int32_t> regions;
    for (const auto& element : mesh.elements) {
      regions.push_back(mesh.points[static_cast<std::size_t>(element[0])][1] < 3 ? 1 : 2);
    }
    constraints.regions = regions;
    for (const SmoothingOptions& options : all_ways(30)) {
      CAPTURE(name_of(options), slid);
      const Run expected = run(mesh, options, constraints);
      SmoothingOptions on_device = options;
      on_device.backend = &cuda::backend();
      const Run found = run(mesh, on_device, constraints);
      if (expected.result.free_vertices > 0) {
        REQUIRE(found.result.backend == "cuda");
      }
      REQUIRE(found.xy == expected.xy);
      REQUIRE(found.result.sweeps == expected.result.sweeps);
      REQUIRE(found.result.reverted_vertices == expected.result.reverted_vertices);
      REQUIRE(found.result.sliding->slid == expected.result.sliding->slid);
      REQUIRE(found.result.sliding->vertices == expected.result.sliding->vertices);
      REQUIRE(found.result.sliding->given_up == expected.result.sliding->given_up);
      REQUIRE(found.result.sliding->largest_deviation == expected.result.sliding->largest_deviation);
      slid += found.result.sliding->slid;
    }
  }
  CHECK(slid > 1000);
}

TEST_CASE("what devices do not do with quadrilaterals is refused, and nothing moves") {
  const MixedMesh mesh(6, 6, 0.2, 1);
  const auto refused = [&](const SmoothingOptions& options) {
    std::vector<double> xy = mesh.xy();
    const std::string said = refusal([&] { smooth(xy_points(xy), mesh.elements, options); });
    CHECK(xy == mesh.xy());
    return said;
  };
  SmoothingOptions options;
  options.backend = &cuda::backend();
  options.execution = Execution::single_block;
  CHECK(refused(options) ==
        "argument: execution 'single-block' smooths triangles alone: quadrilaterals by execution 'resident'");
  options.execution = Execution::cdp;
  CHECK(refused(options) ==
        "argument: execution 'cdp' smooths triangles alone: quadrilaterals by execution 'resident'");
  options.execution = Execution::resident;
  const std::unique_ptr<Backend> one = cuda::backend_on(std::array{0});
  options.backend = one.get();
  require_of_device(run(mesh, options), run(mesh, {}));
}
