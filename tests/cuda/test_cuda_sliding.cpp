// SPDX-License-Identifier: BSD-3-Clause
// Vertices that slide along boundaries and interfaces, on the device: the CPU's bits, counts and deviations.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/cuda/backend.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "support/layered_meshes.h"
#include "support/sliding_meshes.h"

using namespace properties;
using test_meshes::Random;
using trismooth::Evaluation;
using trismooth::Execution;
using trismooth::Progress;
using trismooth::Slide;
using trismooth::SlideCurve;
using trismooth::SlidingResult;
using trismooth::SweepRecord;

namespace cuda = trismooth::cuda;

namespace {

std::string difference_of_sliding(const Run& found, const Run& expected) {
  if (const std::string wrong = difference(found, expected); !wrong.empty()) {
    return wrong;
  }
  if (found.result.sliding.has_value() != expected.result.sliding.has_value()) {
    return "one slides, the other does not";
  }
  if (!found.result.sliding) {
    return {};
  }
  const SlidingResult& here = *found.result.sliding;
  const SlidingResult& there = *expected.result.sliding;
  const bool same = here.given_up == there.given_up && here.chains == there.chains && here.vertices == there.vertices &&
                    here.slid == there.slid && here.largest_deviation == there.largest_deviation &&
                    here.relative_deviation == there.relative_deviation && here.in_same_place == there.in_same_place &&
                    here.at_edges == there.at_edges;
  return same ? std::string()
              : fmt::format("{} of {} slid by {} ({}), not {} of {} by {} ({})", here.slid, here.vertices,
                            here.largest_deviation, here.relative_deviation, there.slid, there.vertices,
                            there.largest_deviation, there.relative_deviation);
}

/// Rings of vertices between two circles, uneven on each, with an interface between two of them.
RandomMesh annulus(std::int32_t around, std::int32_t rings, std::uint64_t seed) {
  RandomMesh mesh;
  mesh.mesh = sliding_meshes::uneven_annulus(around, rings, seed);
  const std::int32_t half = 2 * around * (rings / 2);
  for (std::int32_t t = 0; t < std::ssize(mesh.mesh.triangles); ++t) {
    mesh.regions.push_back(t < half ? 1 : 2);
  }
  return mesh;
}

/// Two squares side by side whose vertices on the common side nearly coincide.
RandomMesh two_squares(std::int32_t side, double gap) {
  RandomMesh mesh;
  mesh.mesh = sliding_meshes::TwoSquares(side, gap).mesh;
  return mesh;
}

RandomMesh uneven_square(std::int32_t side, std::uint64_t seed) {
  RandomMesh mesh;
  mesh.mesh = sliding_meshes::uneven_square(side, 0.25, seed);
  return mesh;
}

void require_cpu_bits(const RandomMesh& mesh, SmoothingOptions options) {
  const Run expected = run(mesh, options);
  options.backend = &cuda::backend();
  const Run found = run(mesh, options);
  CAPTURE(text_of(options), to_string(mesh.slide.along), to_string(mesh.slide.curve));
  REQUIRE(found.result.backend == "cuda");
  REQUIRE(found.result.sliding->slid > 0);
  REQUIRE(difference_of_sliding(found, expected).empty());
}

}  // namespace

TEST_CASE("random meshes slide to the same bits, in every combination, watched, evaluating all, and in plans") {
  std::int64_t slid = 0;
  for_random_meshes(1200, [&](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, Random& random) -> std::string {
      RandomMesh sliding = mesh;
      sliding.slide = any_sliding(random);
      options.guard = random.below(5) != 0;
      options.evaluation = random.below(4) == 0 ? Evaluation::all : Evaluation::changed;
      if (random.below(8) == 0) {
        const std::int64_t last = 1 + random.below(12);
        options.progress = [last](const SweepRecord& record) {
          return record.sweep == last ? Progress::stop : Progress::proceed;
        };
      }
      const Run expected = run(sliding, options);
      options.backend = &cuda::backend();
      auto plan = trismooth::plan(sliding.mesh.vertex_count(), sliding.mesh.indices(), sliding.constraints(), options);
      for (int times = 0; times < 2; ++times) {
        Run found{sliding.mesh.xy(), {}};
        found.result = plan.smooth(found.xy);
        slid += found.result.backend == "cuda" && found.result.sliding ? found.result.sliding->slid : 0;
        if (const std::string wrong = difference_of_sliding(found, expected); !wrong.empty()) {
          return fmt::format("{} (slides {}, corner angle {}, deviation {}, {})", wrong, to_string(sliding.slide.along),
                             sliding.slide.corner_angle, sliding.slide.deviation, to_string(sliding.slide.curve));
        }
      }
      return {};
    });
  });
  CHECK(slid > meshes_of(1200));
}

TEST_CASE("meshes for the patches and for the whole grid slide to the same bits, by every method, form and precision") {
  for (std::uint64_t index = 0; index < combinations; ++index) {
    SmoothingOptions options = combination(index);
    options.threads = 0;
    options.max_sweeps = 60;
    for (const std::int32_t side : {40, 300}) {
      RandomMesh square = uneven_square(side, index);
      square.slide.along = Slide::straight;
      require_cpu_bits(square, options);
    }
    RandomMesh round = annulus(500, 60, index);
    round.slide.along = Slide::curves;
    round.slide.deviation = 1e-2;
    round.slide.curve = index % 3 == 0 ? SlideCurve::spline : SlideCurve::polyline;
    require_cpu_bits(round, options);
  }
}

TEST_CASE("sides that nearly coincide stay or slide as one on the device as on the CPU, and are counted") {
  for (const bool coincident : {false, true}) {
    RandomMesh mesh = two_squares(60, 1e-10);
    mesh.slide.along = Slide::curves;
    mesh.slide.coincident = coincident;
    require_cpu_bits(mesh, {});
    // Where nothing else slides, either.
    mesh.fixed.assign(mesh.mesh.points.size(), 0);
    for (std::size_t v = 0; v < mesh.fixed.size(); ++v) {
      const double x = mesh.mesh.points[v].x;
      mesh.fixed[v] = x < 0.9 || x > 1.1 ? 1 : 0;
    }
    SmoothingOptions options;
    const Run expected = run(mesh, options);
    options.backend = &cuda::backend();
    const Run found = run(mesh, options);
    CHECK((found.result.sliding->in_same_place > 0) == !coincident);
    CHECK(difference_of_sliding(found, expected).empty());
  }
}

TEST_CASE("linked sides stay equal to the bit on the device") {
  constexpr std::int32_t side = 60;
  RandomMesh mesh = uneven_square(side, 5);
  std::vector<std::int32_t> links;
  for (std::int32_t i = 0; i < side; ++i) {
    mesh.mesh.points[i * side + side - 1].y = mesh.mesh.points[i * side].y;
    links.insert(links.end(), {i * side, i * side + side - 1});
  }
  mesh.slide.along = Slide::straight;
  mesh.slide.links = links;
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  require_cpu_bits(mesh, options);
  options.backend = &cuda::backend();
  const Run found = run(mesh, options);
  for (std::int32_t i = 0; i < side; ++i) {
    CHECK(same_bits(found.xy[2 * (i * side) + 1], found.xy[2 * (i * side + side - 1) + 1]));
  }
}

TEST_CASE("the device gives sliding up where the CPU does") {
  for (const std::int32_t side : {41, 200}) {
    RandomMesh mesh;
    mesh.mesh = sliding_meshes::regular_grid(side, 3);
    mesh.slide.along = Slide::straight;
    SmoothingOptions options;
    options.method = Method::mean_ratio;
    const Run expected = run(mesh, options);
    options.backend = &cuda::backend();
    const Run found = run(mesh, options);
    CHECK(expected.result.sliding->given_up);
    CHECK(difference_of_sliding(found, expected).empty());
  }
}

TEST_CASE("layers are held by the device as by the CPU, whoever finds the topology, and where walls slide") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    test_meshes::Random random(seed);
    const test_meshes::Mesh mesh =
        layered_meshes::rectangle({static_cast<std::int32_t>(40 + 60 * seed), layered_meshes::growing(0.004, 1.2, 12),
                                   12, 0.4, seed % 3 == 2 ? 0.4 : 0.0},
                                  random);
    for (const auto method : {trismooth::Method::smart, trismooth::Method::mean_ratio}) {
      for (const bool slides : {false, true}) {
        trismooth::Constraints constraints;
        constraints.slide.along = slides ? trismooth::Slide::straight : trismooth::Slide::off;
        trismooth::SmoothingOptions options;
        options.method = method;
        std::vector<double> expected = mesh.xy();
        const auto by_cpu =
            trismooth::smooth(trismooth::xy_points(expected), mesh.indices(), constraints, options).layers;
        CHECK((by_cpu.kept > 0) == (seed % 3 != 2));
        CHECK((by_cpu.left > 0) == (seed % 3 == 2));
        options.backend = &trismooth::cuda::backend();
        for (const auto topology : {trismooth::Topology::device, trismooth::Topology::host}) {
          options.topology = topology;
          CAPTURE(seed, to_string(method), slides, to_string(topology));
          std::vector<double> xy = mesh.xy();
          const auto layers = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), constraints, options).layers;
          CHECK(xy == expected);
          CHECK(layers.kept == by_cpu.kept);
          CHECK(layers.kept_on_lines == by_cpu.kept_on_lines);
          CHECK(layers.kept_aspect == by_cpu.kept_aspect);
          CHECK(layers.left == by_cpu.left);
          CHECK(layers.left_aspect == by_cpu.left_aspect);
        }
      }
    }
  }
}

TEST_CASE("the paper's executions refuse what slides") {
  RandomMesh mesh = uneven_square(20, 6);
  mesh.slide.along = Slide::straight;
  SmoothingOptions options;
  options.backend = &cuda::backend();
  options.execution = Execution::single_block;
  CHECK_THROWS_AS(run(mesh, options), std::invalid_argument);
}
