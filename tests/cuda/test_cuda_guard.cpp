// SPDX-License-Identifier: BSD-3-Clause
// What comes before and after the sweeps on the device: the local frame and the never-worse commit, against the CPU's.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/primitives/bounding_box.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "smoothing_runs.h"
#include "support/test_meshes.h"

using namespace trismooth;
using namespace smoothing_runs;
using test_meshes::Mesh;
using test_meshes::Random;
using Points = std::vector<Point2<double>>;

namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void require_host_extent(cuda::Context& context, cuda::ExtentFinder& finder, const Points& points) {
  const cuda::DeviceBuffer<Point2<double>> device(context, points);
  finder.find(device.data(), static_cast<std::int32_t>(points.size()));
  const cuda::Extent found = finder.extent();
  const LocalFrame expected = local_frame(points);
  REQUIRE(found.first_not_finite == -1);
  REQUIRE(same_bits(found.frame.centre_x, expected.centre_x));
  REQUIRE(same_bits(found.frame.centre_y, expected.centre_y));
  REQUIRE(found.frame.exponent == expected.exponent);
  // What kernels will read is what the host has been told.
  LocalFrame on_device;
  REQUIRE(cudaMemcpy(&on_device, finder.frame(), sizeof(on_device), cudaMemcpyDeviceToHost) == cudaSuccess);
  REQUIRE(on_device.exponent == expected.exponent);
}

Points random_points(std::size_t count, Point2<double> low, Point2<double> extent, std::uint64_t seed) {
  Random random(seed);
  Points points(count);
  for (auto& p : points) {
    p = {low.x + random.between(0, 1) * extent.x, low.y + random.between(0, 1) * extent.y};
  }
  return points;
}

/// The CPU against the resident execution with the commit queued behind the sweeps, the same with the commit queued
/// when the host knows of the end (a callback, a time limit), and single-block.
void require_cpu_commit(const Mesh& mesh, SmoothingOptions options, const Run& expected) {
  options.backend = &cuda::backend();
  for (const Topology topology : {Topology::host, Topology::device}) {
    options.topology = topology;
    CAPTURE(to_string(topology));
    require_same(run(mesh, options), expected);
  }
  SmoothingOptions watched = options;
  watched.progress = [](const SweepRecord&) { return Progress::proceed; };
  require_same(run(mesh, watched), expected);
  SmoothingOptions timed = options;
  timed.time_limit_seconds = 1e6;
  require_same(run(mesh, timed), expected);
  options.execution = Execution::single_block;
  require_same(run(mesh, options), expected);
}

}  // namespace

TEST_CASE("the device finds the host's local frame of points of every size and place") {
  cuda::Context context;
  cuda::ExtentFinder finder(context);
  const double most = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  for (const std::size_t count : {2, 31, 513, 20'000, 600'000}) {
    CAPTURE(count);
    require_host_extent(context, finder, random_points(count, {0, 0}, {1, 1}, count));
    require_host_extent(context, finder, random_points(count, {4e7, -3e9}, {1.5, 7}, count));
    require_host_extent(context, finder, random_points(count, {-1e-300, 5e-308}, {1e-301, 1e-307}, count));
    require_host_extent(context, finder, random_points(count, {-1e308, 0}, {1.5e308, 1e300}, count));
    require_host_extent(context, finder, random_points(count, {1e5 * least, 0}, {40 * least, 9 * least}, count));
  }
  require_host_extent(context, finder, {{-most, most}, {most, -most}});
  require_host_extent(context, finder, {{least, 0}, {0, -least}});
  require_host_extent(context, finder, {{3, -1e300}});
  require_host_extent(context, finder, {{0.0, 1}, {-0.0, 2}});
  require_host_extent(context, finder, {{-0.0, 1}, {0.0, 2}});
  require_host_extent(context, finder, {});
}

TEST_CASE("points that nothing uses have no say in the frame that the device finds, but must be finite") {
  cuda::Context context;
  cuda::ExtentFinder finder(context);
  for (const std::size_t count : {1, 40, 513, 600'000}) {
    CAPTURE(count);
    const Points used = random_points(count, {3, -1e5}, {1, 1}, count);
    Points points;
    std::vector<std::uint8_t> reasons;
    for (std::size_t i = 0; i < used.size(); ++i) {
      points.push_back(used[i]);
      // A vertex of a line alone is isolated as well, but used.
      constexpr std::array of_used{std::uint8_t{0}, hold::boundary, std::uint8_t{hold::isolated | hold::other_cell}};
      reasons.push_back(of_used[i % 3]);
      if (i % 5 == 0) {
        points.push_back({i % 2 == 0 ? 1e300 : -1e20, i % 4 == 0 ? -1e308 : 7});
        reasons.push_back(i % 2 == 0 ? hold::isolated : hold::isolated | hold::named);
      }
    }
    const cuda::DeviceBuffer<Point2<double>> device(context, points);
    const cuda::DeviceBuffer<std::uint8_t> device_reasons(context, reasons);
    finder.find(device.data(), static_cast<std::int32_t>(points.size()), device_reasons.data());
    const cuda::Extent found = finder.extent();
    const LocalFrame expected = local_frame(used);
    CHECK(found.first_not_finite == -1);
    CHECK(same_bits(found.frame.centre_x, expected.centre_x));
    CHECK(same_bits(found.frame.centre_y, expected.centre_y));
    CHECK(found.frame.exponent == expected.exponent);
  }
  const Points alone{{1e9, 5}, {1, std::numeric_limits<double>::infinity()}};
  const std::vector<std::uint8_t> unused(2, hold::isolated);
  const cuda::DeviceBuffer<Point2<double>> device(context, alone);
  const cuda::DeviceBuffer<std::uint8_t> device_reasons(context, unused);
  finder.find(device.data(), 1, device_reasons.data());
  CHECK(finder.extent().frame.exponent == 0);
  CHECK(finder.extent().frame.centre_x == 0);
  finder.find(device.data(), 2, device_reasons.data());
  CHECK(finder.extent().first_not_finite == 1);
}

TEST_CASE("the first point that is not finite is named, whatever is wrong with it, and the next search is sound") {
  cuda::Context context;
  cuda::ExtentFinder finder(context);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (const std::int32_t first : {0, 1, 300'000, 599'999}) {
      Points points = random_points(600'000, {0, 0}, {1, 1}, 3);
      points[static_cast<std::size_t>(first)].y = bad;
      for (std::size_t i = static_cast<std::size_t>(first) + 7; i < points.size(); i += 1001) {
        points[i].x = bad;
      }
      const cuda::DeviceBuffer<Point2<double>> device(context, points);
      finder.find(device.data(), static_cast<std::int32_t>(points.size()));
      CHECK(finder.extent().first_not_finite == first);
    }
    require_host_extent(context, finder, random_points(1000, {5, 5}, {1, 1}, 4));
  }
}

TEST_CASE("moves that nothing is wrong with are committed at once") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(70, 60, 0.45, 6), 3);
  for (const Form form : forms) {
    for (const Precision precision : precisions) {
      SmoothingOptions options;
      options.form = form;
      options.precision = precision;
      const Run expected = run(mesh, options);
      REQUIRE(expected.result.guard_rounds == 0);
      REQUIRE(expected.result.moved_vertices > 0);
      require_cpu_commit(mesh, options, expected);
    }
  }
}

TEST_CASE("Form A that is stopped early leaves offenders, and the same ones go back") {
  for (const std::int32_t side : {60, 300}) {
    const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(side, side, 0.6, 2), 5);
    for (const Precision precision : precisions) {
      SmoothingOptions options;
      options.form = Form::swap;
      options.precision = precision;
      options.max_sweeps = 1;
      const Run expected = run(mesh, options);
      REQUIRE(expected.result.guard_rounds > 0);
      require_cpu_commit(mesh, options, expected);
    }
  }
}

TEST_CASE("plain averages do damage in many rounds, and the same is taken back in each") {
  const Mesh annulus = test_meshes::annulus(40, 12, 0.8);
  for (const Mesh& mesh :
       {test_meshes::shuffled(annulus, 8), test_meshes::together(annulus, test_meshes::tangled(30, 7), {3, 0})}) {
    for (const Form form : forms) {
      SmoothingOptions options;
      options.form = form;
      options.method = Method::laplacian;
      options.max_sweeps = 20;
      const Run expected = run(mesh, options);
      REQUIRE(expected.result.guard_rounds > 1);
      require_cpu_commit(mesh, options, expected);
      const Run in_float32 = run(mesh, options, {}, Storage::float32);
      options.backend = &cuda::backend();
      require_same(run(mesh, options, {}, Storage::float32), in_float32);
    }
  }
}

TEST_CASE("more offenders than the list has room for go back all the same, and the plan is fit for the next run") {
  struct Case {
    Mesh mesh;
    std::int64_t max_sweeps;
  };
  // Too many in the first round; in a later one; in the first and together again; in many small ones.
  for (const Case& tried :
       {Case{test_meshes::tangled(300, 7), 1}, Case{test_meshes::tangled(205, 7), 1},
        Case{test_meshes::annulus(400, 30, 0.9), 200}, Case{test_meshes::annulus(300, 100, 0.8), 20}}) {
    const Mesh mesh = test_meshes::shuffled(tried.mesh, 9);
    SmoothingOptions options;
    options.form = Form::swap;
    options.method = Method::laplacian;
    options.max_sweeps = tried.max_sweeps;
    const Run expected = run(mesh, options);
    REQUIRE(expected.result.guard_rounds > 1);
    REQUIRE(expected.result.reverted_vertices >
            cuda::GuardBuffers::list_size(static_cast<std::int32_t>(expected.result.free_vertices)));
    require_cpu_commit(mesh, options, expected);
    options.backend = &cuda::backend();
    auto again = plan(mesh.vertex_count(), mesh.indices(), {}, options);
    for (int i = 0; i < 2; ++i) {
      Run found{mesh.xy(), {}};
      found.result = again.smooth(found.xy);
      require_same(found, expected);
    }
  }
}

TEST_CASE("without the guard all moves are written") {
  for (const Mesh& mesh : {test_meshes::tangled(30, 7), test_meshes::jittered_grid(60, 60, 0.6, 2)}) {
    for (const Form form : forms) {
      SmoothingOptions options;
      options.form = form;
      options.method = Method::laplacian;
      options.guard = false;
      const Run expected = run(mesh, options);
      require_cpu_commit(mesh, options, expected);
    }
  }
}

TEST_CASE("sweeps that go to and fro for ever have the history of real ones, up to any limit") {
  // Plain means in single precision, all from the sweep before, end in two states that differ by rounding.
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.2, 66);
  for (const Form form : forms) {
    for (const Precision precision : precisions) {
      for (const std::int64_t limit : {255, 256, 257, 1000, 1001}) {
        CAPTURE(to_string(form), to_string(precision), limit);
        SmoothingOptions options;
        options.method = Method::laplacian;
        options.form = form;
        options.precision = precision;
        options.tolerance = 0;
        options.max_sweeps = limit;
        options.record_min_shape = limit == 1001;
        const Run expected = run(mesh, options);
        if (form == Form::swap && precision == Precision::single_precision) {
          REQUIRE(expected.result.sweeps == limit);
        }
        options.backend = &cuda::backend();
        const Run found = run(mesh, options);
        require_same(found, expected);
        CHECK(found.result.vertex_updates == expected.result.vertex_updates);
        for (std::size_t i = 0; i < found.result.history.size(); ++i) {
          REQUIRE(found.result.history[i].evaluated == expected.result.history[i].evaluated);
          if (options.record_min_shape) {
            REQUIRE(found.result.history[i].min_shape == expected.result.history[i].min_shape);
          }
        }
      }
    }
  }
}

TEST_CASE("a plan refuses coordinates that are not finite, names the first, and goes on with the next") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(25, 20, 0.45, 6), 3);
  const Run expected = run(mesh, {});
  cuda::Context context;
  const cuda::DeviceBuffer<std::int32_t> triangles(context, mesh.indices());
  const cuda::DeviceMesh device_mesh{
      mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()), triangles.data(), {}};
  cuda::DeviceBuffer<double> xy(context, mesh.xy());
  cuda::Plan plan(device_mesh, {}, context.stream());
  for (int i = 0; i < 3; ++i) {
    std::vector<double> broken = mesh.xy();
    broken[std::size_t{2} * 17 + 1] = std::numeric_limits<double>::quiet_NaN();
    broken[std::size_t{2} * 300] = std::numeric_limits<double>::infinity();
    xy.upload(broken);
    CHECK_THROWS_WITH(plan.smooth(xy.data()), "vertex 17 has a coordinate that is not finite");
    std::vector<double> after(broken.size());
    xy.download(after);
    CHECK(std::memcmp(after.data(), broken.data(), after.size() * sizeof(double)) == 0);

    xy.upload(mesh.xy());
    Run found{mesh.xy(), {}};
    found.result = plan.smooth(xy.data());
    xy.download(found.xy);
    require_same(found, expected);
  }
}
