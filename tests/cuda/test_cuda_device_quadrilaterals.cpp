// SPDX-License-Identifier: BSD-3-Clause
// Meshes with quadrilaterals in device memory against the CPU, in all that results say.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/rounding.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/uploaded_constraints.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "device_ways.h"
#include "mixed_runs.h"
#include "smoothing_runs.h"
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
using smoothing_runs::require_same;
using smoothing_runs::Run;
using test_support::refusal;

namespace {

const std::string found_by_host = "the host found the neighbours: of a mesh with quadrilaterals no device does";

std::vector<std::int32_t> numbers_of(const std::vector<MixedElement>& elements) {
  std::vector<std::int32_t> numbers;
  for (const MixedElement& element : elements) {
    numbers.insert(numbers.end(), element.begin(), element.end());
  }
  return numbers;
}

/// A mesh in device memory, smoothed there by a plan as often as asked.
class OnDevice {
 public:
  OnDevice(const MixedMesh& mesh, const SmoothingOptions& options, const Constraints& constraints = {})
      : elements_(context_, numbers_of(mesh.elements)),
        constraints_(context_, constraints),
        plan_({mesh.vertex_count(), static_cast<std::int32_t>(mesh.elements.size()), elements_.data(),
               constraints_.view(), 4},
              options, context_.stream()) {}

  Run smooth(const std::vector<double>& xy, Storage storage = Storage::float64) {
    cuda::DeviceBuffer<double> device(context_, xy);
    Run run{xy, {}};
    run.result = plan_.smooth(device.data(), storage);
    device.download(run.xy);
    return run;
  }

  /// Coordinates as float32, there as here.
  Run smooth_floats(const std::vector<double>& xy) {
    std::vector<float> floats(xy.size());
    std::ranges::transform(xy, floats.begin(), [](double x) { return static_cast<float>(x); });
    cuda::DeviceBuffer<float> device(context_, floats);
    Run run;
    run.result = plan_.smooth(device.data());
    device.download(floats);
    run.xy.assign(floats.begin(), floats.end());
    return run;
  }

  std::vector<std::uint8_t> fixed() const { return plan_.fixed(); }

 private:
  cuda::Context context_;
  cuda::DeviceBuffer<std::int32_t> elements_;
  cuda::UploadedConstraints constraints_;
  cuda::Plan plan_;
};

/// What the CPU made of it, where it need not be untangled.
Run require_cpu_bits(const MixedMesh& mesh, SmoothingOptions options, const Constraints& constraints = {},
                     Storage storage = Storage::float64) {
  options.untangle = Untangle::off;
  const Run expected = run(mesh, options, constraints, storage);
  const Run found = OnDevice(mesh, options, constraints).smooth(mesh.xy(), storage);
  require_of_device(found, expected);
  REQUIRE(found.result.backend_note == found_by_host);
  return expected;
}

/// The points with x times the factor.
std::vector<double> stretched(std::vector<double> xy, double factor) {
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    xy[i] *= factor;
  }
  return xy;
}

/// The points of both, so that each mesh is a component of its own.
MixedMesh beside_each_other(MixedMesh mesh, const MixedMesh& other) {
  const std::int32_t first = mesh.vertex_count();
  for (const auto& [x, y] : other.points) {
    mesh.points.push_back({x + 100, y});
  }
  for (const auto& [a, b, c, d] : other.elements) {
    mesh.elements.push_back({a + first, b + first, c + first, d < 0 ? d : d + first});
  }
  return mesh;
}

}  // namespace

TEST_CASE("random meshes with quadrilaterals in device memory have the CPU's bits by every method") {
  std::int64_t reverted = 0;
  for (const MixedMesh& mesh : random_meshes(30)) {
    for (SmoothingOptions options : all_ways(20)) {
      for (const bool measures : {false, true}) {
        CAPTURE(mesh.points.front()[0], name_of(options), measures);
        options.record_min_shape = measures;
        reverted += require_cpu_bits(mesh, options).result.reverted_vertices;
      }
    }
  }
  CHECK(reverted > 100);
}

TEST_CASE("large meshes with quadrilaterals in device memory have the CPU's bits to their stop") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    const MixedMesh mesh = MixedMesh(160, 150, 0.4, 3, thirds).listed_from_other_corners(7, true).in_another_order(2);
    for (const SmoothingOptions& options : all_ways(400)) {
      CAPTURE(thirds, name_of(options));
      require_cpu_bits(mesh, options);
    }
  }
}

TEST_CASE("quadrilaterals in device memory are rounded as they are stored, and float is taken") {
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
      options.untangle = Untangle::off;
      const Run expected = require_cpu_bits(mesh, options, {}, Storage::float32);
      require_of_device(OnDevice(mesh, options).smooth_floats(mesh.xy()), expected);
    }
  }
}

TEST_CASE("plans of quadrilaterals in device memory have the CPU's bits in every call, whichever way they turn") {
  const MixedMesh one = MixedMesh(15, 12, 0.35, 2).listed_from_other_corners(3, true);
  const MixedMesh mesh = beside_each_other(one, MixedMesh(9, 14, 0.3, 5).in_another_order(4));
  std::vector<double> half_turned = mesh.xy();
  for (std::size_t v = 0; v < one.points.size(); ++v) {
    half_turned[2 * v] *= -1;
  }
  for (const SmoothingOptions& options : all_ways(30)) {
    CAPTURE(name_of(options));
    SmoothingPlan on_cpu = plan(mesh.vertex_count(), mesh.elements, options);
    OnDevice on_device(mesh, options);
    CHECK(on_device.fixed() == on_cpu.fixed());
    for (const std::vector<double>& points :
         {mesh.xy(), stretched(mesh.xy(), 0.5), stretched(mesh.xy(), -1), half_turned, stretched(mesh.xy(), 2)}) {
      Run expected{points, {}};
      expected.result = on_cpu.smooth(expected.xy);
      require_of_device(on_device.smooth(points), expected);
    }
    CHECK(on_device.fixed() == on_cpu.fixed());
  }
}

TEST_CASE("vertices of quadrilaterals in device memory are held as on the CPU, for every reason") {
  const MixedMesh mesh = MixedMesh(30, 20, 0.35, 4).listed_from_other_corners(3, true);
  std::vector<std::uint8_t> fixed(mesh.points.size());
  std::vector<std::uint8_t> other_cells(mesh.points.size());
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    fixed[v] = v % 17 == 0 ? 1 : 0;
    other_cells[v] = v % 29 == 0 ? 1 : 0;
  }
  std::vector<std::int32_t> regions(mesh.elements.size());
  for (std::size_t e = 0; e < regions.size(); ++e) {
    regions[e] = static_cast<std::int32_t>(e % 9 / 8);
  }
  const std::vector<std::int32_t> ids{40, 41, 3};
  const Constraints all{.fixed = fixed, .fixed_ids = ids, .other_cells = other_cells, .regions = regions};
  for (const SmoothingOptions& options : all_ways(40)) {
    CAPTURE(name_of(options));
    require_cpu_bits(mesh, options, all);
  }
  CHECK(OnDevice(mesh, {}, all).fixed() == plan(mesh.vertex_count(), mesh.elements, all).fixed());
  const MixedMesh layered = with_layers();
  for (const Layers layers : {Layers::keep, Layers::smooth, Layers::automatic}) {
    SmoothingOptions options;
    options.method = Method::mean_ratio;
    options.layers = layers;
    options.untangle = Untangle::off;
    const Run expected = require_cpu_bits(layered, options);
    CHECK((expected.result.layers.kept > 100) == (layers != Layers::smooth));
    SmoothingPlan on_cpu = plan(layered.vertex_count(), layered.elements, options);
    OnDevice on_device(layered, options);
    std::vector<double> xy = layered.xy();
    on_cpu.smooth(xy);
    on_device.smooth(layered.xy());
    CHECK(on_device.fixed() == on_cpu.fixed());
  }
}

TEST_CASE("sizes, targets, limits and callers that stop have the CPU's bits with quadrilaterals in device memory") {
  const MixedMesh mesh(24, 20, 0.4, 6);
  std::vector<double> lengths;
  for (const auto& [x, y] : mesh.points) {
    lengths.push_back(0.5 + x / 40 + y / 100);
  }
  for (SmoothingOptions options : all_ways(60)) {
    CAPTURE(name_of(options));
    if (options.method == Method::mean_ratio) {
      options.mean_ratio.target_lengths = lengths;
      require_cpu_bits(mesh, options);
      options.mean_ratio.target_lengths = {};
    }
    for (const double target : {-1.0, 0.05, 0.4, 1.0}) {
      options.target_quality = target;
      require_cpu_bits(mesh, options);
    }
    options.target_quality.reset();
    options.guard = false;
    require_cpu_bits(mesh, options);
    options.guard = true;
    options.progress = [](const SweepRecord& record) { return record.sweep == 3 ? Progress::stop : Progress::proceed; };
    require_cpu_bits(mesh, options);
  }
}

TEST_CASE("meshes without a free vertex, far or tiny ones, and none of quadrilaterals in device memory are smoothed") {
  for (const std::int32_t rows : {1, 2}) {
    const MixedMesh mesh(1, rows, 0.1, 3, 0);
    SmoothingOptions options;
    options.record_min_shape = true;
    const Run found = OnDevice(mesh, options).smooth(mesh.xy());
    CHECK(found.result.free_vertices == 0);
    CHECK(found.result.quadrilaterals == rows);
    CHECK(found.xy == mesh.xy());
  }
  for (const double scale : {1.0, 1e-9, 1e200}) {
    for (const double offset : {0.0, 4e7}) {
      MixedMesh mesh(9, 11, 0.3, 8);
      for (auto& [x, y] : mesh.points) {
        x = (x + offset) * scale;
        y = (y - offset) * scale;
      }
      CAPTURE(scale, offset);
      require_cpu_bits(mesh, {});
    }
  }
  const MixedMesh nothing;
  CHECK(OnDevice(nothing, {}).smooth({}).result.backend_note.empty());
}

TEST_CASE("tangled meshes of quadrilaterals in device memory are untangled by the CPU, the others are the device's") {
  int of_host = 0;
  int of_device = 0;
  std::vector<MixedMesh> meshes = random_meshes(20);
  for (const std::uint64_t thirds : {0U, 1U}) {
    meshes.emplace_back(20, 15, 0.2, 4, thirds);
    meshes.emplace_back(20, 15, 0.5, 4, thirds);
  }
  for (const MixedMesh& mesh : meshes) {
    for (SmoothingOptions options : all_ways(15)) {
      CAPTURE(mesh.points.front()[0], name_of(options));
      options.untangle = Untangle::on;
      const Run expected = run(mesh, options);
      const Run found = OnDevice(mesh, options).smooth(mesh.xy());
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
      const bool is_tangled = there.inverted_before > 0;
      CHECK(found.result.backend == (is_tangled ? "cpu" : "cuda"));
      CHECK(found.result.backend_note ==
            found_by_host + (is_tangled ? "; the mesh has inverted elements, which the CPU untangles" : ""));
      ++(is_tangled ? of_host : of_device);
    }
  }
  CHECK(of_host > 100);
  CHECK(of_device > 30);
}

TEST_CASE("vertices of quadrilaterals in device memory slide along lines to the CPU's bits, layers apart") {
  std::vector<MixedMesh> meshes = random_meshes(30);
  meshes.push_back(with_layers());
  std::int64_t slid = 0;
  std::int64_t kept_on_lines = 0;
  for (const MixedMesh& mesh : meshes) {
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
      OnDevice on_device(mesh, options, constraints);
      for (int times = 0; times < 2; ++times) {
        const Run found = on_device.smooth(mesh.xy());
        if (expected.result.free_vertices > 0) {
          REQUIRE(found.result.backend == "cuda");
        }
        REQUIRE(found.xy == expected.xy);
        REQUIRE(found.result.sweeps == expected.result.sweeps);
        REQUIRE(found.result.reverted_vertices == expected.result.reverted_vertices);
        REQUIRE(found.result.inverted == expected.result.inverted);
        REQUIRE(found.result.layers.kept == expected.result.layers.kept);
        REQUIRE(found.result.layers.kept_on_lines == expected.result.layers.kept_on_lines);
        REQUIRE(found.result.sliding->slid == expected.result.sliding->slid);
        REQUIRE(found.result.sliding->vertices == expected.result.sliding->vertices);
        REQUIRE(found.result.sliding->given_up == expected.result.sliding->given_up);
        REQUIRE(found.result.sliding->largest_deviation == expected.result.sliding->largest_deviation);
        slid += found.result.sliding->slid;
        kept_on_lines += found.result.layers.kept_on_lines;
      }
    }
  }
  CHECK(slid > 1000);
  CHECK(kept_on_lines > 0);
}

TEST_CASE("triangles in device memory with four numbers each are what they are with three, by every execution") {
  const MixedMesh mesh = MixedMesh(25, 20, 0.4, 6, 3).listed_from_other_corners(3, true);
  std::vector<std::int32_t> three;
  for (const auto& [a, b, c, none] : mesh.elements) {
    three.insert(three.end(), {a, b, c});
  }
  cuda::Context context;
  const cuda::DeviceBuffer<std::int32_t> triangles(context, three);
  const cuda::DeviceMesh of_three{mesh.vertex_count(), static_cast<std::int32_t>(mesh.elements.size()),
                                  triangles.data()};
  std::vector<SmoothingOptions> ways = all_ways(30);
  for (const device_ways::DeviceWay& way : device_ways::paper_ways()) {
    way.choose_in(ways.emplace_back());
  }
  for (const SmoothingOptions& options : ways) {
    CAPTURE(name_of(options), to_string(options.execution));
    cuda::DeviceBuffer<double> xy(context, mesh.xy());
    Run expected{mesh.xy(), {}};
    expected.result = cuda::smooth(of_three, xy.data(), options, context.stream());
    xy.download(expected.xy);
    const Run found = OnDevice(mesh, options).smooth(mesh.xy());
    require_same(found, expected);
    CHECK(found.result.kernel_launches == expected.result.kernel_launches);
    CHECK(found.result.inverted == expected.result.inverted);
    CHECK(found.result.quadrilaterals == 0);
    CHECK(found.result.backend_note.empty());
  }
}

TEST_CASE("elements in device memory that are no mesh are refused with the host's message") {
  const MixedMesh mesh(6, 6, 0.2, 1, 1);
  const auto refusals = [](const MixedMesh& wrong, const Constraints& constraints = {}) {
    return std::pair(refusal([&] { OnDevice(wrong, {}, constraints); }),
                     refusal([&] { (void)plan(wrong.vertex_count(), wrong.elements, constraints); }));
  };
  const auto quadrilateral = static_cast<std::size_t>(
      std::ranges::find_if(mesh.elements, [](const auto& element) { return element[3] >= 0; }) - mesh.elements.begin());
  const auto with = [&](std::size_t element, std::size_t corner, std::int32_t number) {
    MixedMesh wrong = mesh;
    wrong.elements[element][corner] = number;
    return refusals(wrong);
  };
  for (const std::int32_t number : {-1, -2, 49, std::numeric_limits<std::int32_t>::min()}) {
    CAPTURE(number);
    const auto [here, there] = with(quadrilateral, 1, number);
    CHECK(here == there);
    CHECK(here.starts_with("mesh: element " + std::to_string(quadrilateral)));
  }
  for (const std::size_t corner : {0U, 1U, 2U}) {
    const auto [here, there] = with(quadrilateral, corner, mesh.elements[quadrilateral][3]);
    CHECK(here == there);
    CHECK(here.find("repeats a vertex") != std::string::npos);
  }
  MixedMesh not_in_turn = mesh;
  std::swap(not_in_turn.elements[quadrilateral][1], not_in_turn.elements[quadrilateral][2]);
  const auto [here, there] = refusals(not_in_turn);
  CHECK(here == there);
  const std::vector<std::int32_t> no_vertex{99};
  const auto [of_ids, on_host] = refusals(mesh, {.fixed_ids = no_vertex});
  CHECK(of_ids == on_host);
  CHECK(of_ids.starts_with("argument: fixed vertex 99"));
}

TEST_CASE("what no device does with quadrilaterals in its memory is refused by name, and nothing moves") {
  const MixedMesh mesh(6, 6, 0.2, 1);
  SmoothingOptions options;
  for (const auto& [execution, name] :
       {std::pair(Execution::single_block, "single-block"), std::pair(Execution::cdp, "cdp")}) {
    options.execution = execution;
    CHECK(refusal([&] { OnDevice(mesh, options); }) == std::string("argument: execution '") + name +
                                                           "' smooths triangles alone: quadrilaterals by execution "
                                                           "'resident'");
  }
  OnDevice on_device(mesh, {});
  std::vector<double> wrong = mesh.xy();
  wrong[21] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal([&] { on_device.smooth(wrong); }) == "mesh: vertex 10 has a coordinate that is not finite");
  require_of_device(on_device.smooth(mesh.xy()), run(mesh, {}));
}
