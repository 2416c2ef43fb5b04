// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/smooth.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/rounding.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/naive_smoothing.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::smooth_test {

using test_meshes::Mesh;
using test_meshes::Point;

// A plan takes triangles that are there, and has one owner.
template <class Triangles>
concept CanBePlanned = requires(Triangles&& triangles, const Constraints& constraints) {
  { plan(4, std::forward<Triangles>(triangles)) } -> std::same_as<SmoothingPlan>;
  { plan(4, std::forward<Triangles>(triangles), constraints) } -> std::same_as<SmoothingPlan>;
};
static_assert(CanBePlanned<std::vector<std::int32_t>&> && !CanBePlanned<std::vector<std::int32_t>>);
static_assert(!std::is_copy_constructible_v<SmoothingPlan> && std::is_nothrow_move_constructible_v<SmoothingPlan>);

constexpr auto methods = trismooth::values_of<Method>();
constexpr Form forms[] = {Form::swap, Form::in_place};
constexpr Precision precisions[] = {Precision::double_precision, Precision::single_precision};

std::vector<double> smoothed(const Mesh& mesh, const SmoothingOptions& options = {}) {
  std::vector<double> xy = mesh.xy();
  smooth(xy_points(xy), mesh.indices(), {}, options);
  return xy;
}

/// Calls `use` with options of every method, form and precision.
template <class Function>
void for_all_options(const Function& use) {
  for (const Method method : methods) {
    for (const Form form : forms) {
      for (const Precision precision : precisions) {
        CAPTURE(method, form, precision);
        SmoothingOptions options;
        options.method = method;
        options.form = form;
        options.precision = precision;
        options.max_sweeps = 30;
        use(options);
      }
    }
  }
}

std::vector<double> times(std::vector<double> xy, double factor) {
  for (double& x : xy) {
    x *= factor;
  }
  return xy;
}

Mesh with_coordinates(Mesh mesh, const std::vector<double>& xy) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    mesh.points[v] = {xy[2 * v], xy[2 * v + 1]};
  }
  return mesh;
}

double worst_quotient(const Mesh& mesh) {
  double worst = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    worst = std::min(worst, naive::element_quotient(mesh.points, t));
  }
  return worst;
}

TEST_CASE("huge and tiny meshes are smoothed like others, to rounding") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(12, 12, 0.3, 1), 2);
  SmoothingOptions options;
  options.method = Method::laplacian;
  options.guard = false;
  options.max_sweeps = 30;
  for (const Form form : forms) {
    options.form = form;
    const std::vector<double> expected = smoothed(mesh, options);
    for (const double factor : {1e-300, 1e-200, 1e-9, 1e200, 1e307}) {
      CAPTURE(factor);
      const std::vector<double> found = smoothed(with_coordinates(mesh, times(mesh.xy(), factor)), options);
      double largest_error = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        largest_error = std::max(largest_error, std::abs(found[i] / factor - expected[i]));
      }
      CHECK(largest_error < 1e-13);
    }
  }
}

TEST_CASE("coordinates as large as numbers are stay finite, without the guard too") {
  // The mean of equal numbers may be rounded to a larger one.
  for (const Storage storage : {Storage::float64, Storage::float32}) {
    const double largest = trismooth::largest_stored(storage);
    for (const double side : {largest, -largest}) {
      for (std::int32_t size = 3; size < 40; ++size) {
        Mesh mesh = test_meshes::star(size);
        for (Point& p : mesh.points) {
          p = {side, trismooth::rounded_to_float32(p.y) * (largest / 4)};
        }
        mesh.points[0].x = side / 4;
        for_all_options([&](SmoothingOptions options) {
          CAPTURE(largest, side, size);
          options.guard = false;
          std::vector<double> xy = mesh.xy();
          plan(mesh.vertex_count(), mesh.indices(), {}, options).smooth(xy, storage);
          REQUIRE(std::ranges::all_of(xy, [&](double x) { return std::abs(x) <= largest; }));
        });
      }
    }
  }
}

TEST_CASE("far from the origin the result is finite and not worse") {
  const Mesh unit = test_meshes::shuffled(test_meshes::jittered_grid(15, 15, 0.6, 3), 4);
  for (const double offset : {4e7, -4e7, 1e12, 3e15}) {
    std::vector<double> xy = unit.xy();
    for (std::size_t i = 0; i < xy.size(); i += 2) {
      xy[i] = xy[i] * 100 + offset;
      xy[i + 1] = xy[i + 1] * 100 - offset / 3;
    }
    const Mesh mesh = with_coordinates(unit, xy);
    for_all_options([&](const SmoothingOptions& options) {
      CAPTURE(offset);
      const std::vector<double> found = smoothed(mesh, options);
      CHECK(std::ranges::all_of(found, [](double x) { return std::isfinite(x); }));
      CHECK(worst_quotient(with_coordinates(mesh, found)) >= worst_quotient(mesh));
      CHECK_FALSE(found == xy);
    });
  }
}

TEST_CASE("a translation that the coordinates can hold changes the result by rounding only, however far it is") {
  const Mesh unit = test_meshes::jittered_grid(12, 12, 0.3, 1);
  SmoothingOptions options;
  options.method = Method::laplacian;
  options.guard = false;
  options.max_sweeps = 20;
  // On a grid of 2^-20, so that the mesh 2^26 away is the same mesh.
  std::vector<double> near;
  std::vector<double> far;
  for (const double x : unit.xy()) {
    near.push_back(std::round(x * 0x1p20) * 0x1p-20);
    far.push_back(near.back() + 0x1p26);
  }
  const std::vector<double> near_result = smoothed(with_coordinates(unit, near), options);
  const std::vector<double> far_result = smoothed(with_coordinates(unit, far), options);
  double largest_error = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    largest_error = std::max(largest_error, std::abs(far_result[i] - 0x1p26 - near_result[i]));
  }
  CHECK(largest_error < 0x1p-26);  // coordinates there are 2^-26 apart
}

TEST_CASE("a plan follows a component that is mirrored between two calls, and back") {
  const Mesh grid = test_meshes::jittered_grid(10, 10, 0.35, 1);
  const Mesh mesh = test_meshes::together(grid, test_meshes::jittered_grid(9, 9, 0.35, 2), {5, 0});
  Mesh other_side = mesh;
  for (std::size_t v = grid.points.size(); v < mesh.points.size(); ++v) {
    other_side.points[v].x = 11 - mesh.points[v].x;
  }
  const Mesh mirrored = other_side;
  for_all_options([&](const SmoothingOptions& options) {
    SmoothingPlan repeated = plan(mesh.vertex_count(), mesh.indices(), {}, options);
    for (const Mesh* now : {&mesh, &mirrored, &mesh, &mirrored, &mirrored}) {
      std::vector<double> planned = now->xy();
      repeated.smooth(planned);
      REQUIRE(same_bits(planned, smoothed(*now, options)));
      REQUIRE_FALSE(same_bits(planned, now->xy()));
    }
  });
}

TEST_CASE("a plan can be moved, and owns what it needs") {
  const Mesh mesh = test_meshes::jittered_grid(10, 10, 0.35, 1);
  const std::vector<double> expected = smoothed(mesh);
  std::vector<SmoothingPlan> plans;
  {
    const auto indices_there = mesh.indices();
    std::vector<std::int32_t> indices(indices_there.begin(), indices_there.end());
    plans.push_back(plan(mesh.vertex_count(), indices));
    std::ranges::fill(indices, -1);
  }
  std::vector<double> xy = mesh.xy();
  plans.back().smooth(xy);
  SmoothingPlan moved = std::move(plans.back());
  plans.clear();
  std::vector<double> again = mesh.xy();
  moved.smooth(again);
  CHECK(xy == expected);
  CHECK(again == expected);
}

TEST_CASE("constraints may be left out, with options and without") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(9, 8, 0.35, 6), 7);
  SmoothingOptions options;
  options.form = Form::swap;
  options.max_sweeps = 4;
  std::vector<double> expected = mesh.xy();
  smooth(xy_points(expected), mesh.triangles, Constraints{}, options);
  std::vector<double> xy = mesh.xy();
  smooth(xy_points(xy), mesh.triangles, options);
  CHECK(xy == expected);
  xy = mesh.xy();
  plan(mesh.vertex_count(), mesh.triangles, options).smooth(xy);
  CHECK(xy == expected);
  xy = mesh.xy();
  smooth(xy_points(xy), mesh.triangles, {.form = Form::swap, .max_sweeps = 4});
  CHECK(xy == expected);
  const std::vector<std::uint8_t> all(mesh.points.size(), 1);
  xy = mesh.xy();
  CHECK(smooth(xy_points(xy), mesh.triangles, {.fixed = all}).free_vertices == 0);
  smooth(xy_points(xy), mesh.triangles);
  CHECK(xy == smoothed(mesh));
}

TEST_CASE("vertices that the caller fixes do not move, and the others move as if they were boundary") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(15, 15, 0.4, 1), 2);
  test_meshes::Random random(3);
  std::vector<std::int32_t> ids;
  std::vector<std::uint8_t> flags(mesh.points.size(), 0);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (random.below(5) == 0) {
      ids.push_back(v);
      flags[v] = 1;
    }
  }
  Constraints by_id;
  by_id.fixed_ids = ids;
  Constraints by_flag;
  by_flag.fixed = flags;
  for_all_options([&](const SmoothingOptions& options) {
    std::vector<double> xy = mesh.xy();
    const SmoothingResult result = smooth(xy_points(xy), mesh.indices(), by_id, options);
    CHECK(result.moved_vertices > 50);
    for (const std::int32_t v : ids) {
      REQUIRE((xy[2 * v] == mesh.points[v].x && xy[2 * v + 1] == mesh.points[v].y));
    }
    std::vector<double> flagged = mesh.xy();
    smooth(xy_points(flagged), mesh.indices(), by_flag, options);
    REQUIRE(same_bits(flagged, xy));
  });
}

TEST_CASE("triangles that are listed again free no vertex and are not inverted, however they are listed") {
  const Mesh mesh = test_meshes::jittered_grid(6, 5, 0.2, 7);
  const auto is_inside = [](std::int32_t v) { return v % 6 > 0 && v % 6 < 5 && v / 6 > 0 && v / 6 < 4; };
  test_meshes::Random random(11);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    Mesh with_copies = mesh;
    for (std::int32_t copies = 1 + random.below(i < 100 ? 1 : 40); copies > 0; --copies) {
      with_copies.triangles.push_back(mesh.triangles[random.below(static_cast<std::int32_t>(mesh.triangles.size()))]);
      random.shuffle(with_copies.triangles.back());
    }
    random.shuffle(with_copies.triangles);
    for (const Method method : methods) {
      std::vector<double> xy = with_copies.xy();
      const SmoothingResult result = smooth(xy_points(xy), with_copies.indices(), {.method = method, .guard = false});
      CHECK(result.inverted == 0);
      CHECK(result.degenerate == 0);
      for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto x = static_cast<std::size_t>(2 * v);
        REQUIRE((is_inside(v) || (xy[x] == mesh.points[v].x && xy[x + 1] == mesh.points[v].y)));
      }
    }
  }
}

TEST_CASE("negative zeros, subnormals and whatever else stays where it is keep their bits") {
  Mesh mesh = test_meshes::jittered_grid(8, 8, 0.4, 1);
  for (Point& p : mesh.points) {
    p.x = p.x == 0 ? -0.0 : p.x;
    p.y = p.y == 0 ? 5e-324 : p.y;
  }
  for_all_options([&](const SmoothingOptions& options) {
    const std::vector<double> before = mesh.xy();
    const std::vector<double> after = smoothed(mesh, options);
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      if (v % 8 == 0 || v % 8 == 7 || v / 8 == 0 || v / 8 == 7) {
        REQUIRE(same_bits({after[2 * v], after[2 * v + 1]}, {before[2 * v], before[2 * v + 1]}));
      }
    }
  });
}

TEST_CASE("a mesh of nothing, of isolated vertices or without a free vertex is done in one sweep") {
  for (const Mesh& mesh : {Mesh{}, Mesh{{{0, 0}, {1, 1}}, {}}, test_meshes::three_on_an_edge(), test_meshes::bow_tie(),
                           Mesh{{{3, 3}, {3, 3}, {3, 3}}, {{0, 1, 2}}}}) {
    for_all_options([&](const SmoothingOptions& options) {
      std::vector<double> xy = mesh.xy();
      const SmoothingResult result = smooth(xy_points(xy), mesh.indices(), {}, options);
      CHECK(result.stop_reason == StopReason::fixed_point);
      CHECK(result.sweeps == 1);
      CHECK(result.free_vertices == 0);
      CHECK(result.moved_vertices == 0);
      CHECK(same_bits(xy, mesh.xy()));
    });
  }
}

TEST_CASE("a free vertex whose whole ring is one point is left in peace or brought there") {
  Mesh mesh = test_meshes::star(5);
  for (Point& p : mesh.points) {
    p = {2, 7};
  }
  for_all_options([&](const SmoothingOptions& options) { CHECK(same_bits(smoothed(mesh, options), mesh.xy())); });
  mesh.points[0] = {3, 7};
  for_all_options([&](const SmoothingOptions& options) {
    const std::vector<double> after = smoothed(mesh, options);
    CHECK(std::ranges::all_of(after, [](double x) { return std::isfinite(x); }));
  });
}

TEST_CASE("without a backend in the options it is the CPU's") {
  SmoothingOptions options;
  CHECK(&trismooth::backend_of(options) == &trismooth::cpu_backend());
  options.backend = &trismooth::cpu_backend();
  CHECK(&trismooth::backend_of(options) == &trismooth::cpu_backend());
  CHECK(trismooth::cpu_backend().name() == "cpu");
}

TEST_CASE("a plan that could not be prepared anew does not go on with what it had for another orientation") {
  const Mesh mesh = test_meshes::jittered_grid(8, 7, 0.4, 3);
  std::vector<double> mirrored = mesh.xy();
  for (std::size_t i = 0; i < mirrored.size(); i += 2) {
    mirrored[i] = -mirrored[i];
  }
  std::vector<double> expected = mirrored;
  smooth(xy_points(expected), mesh.indices());

  fakes::FakeBackend device;
  SmoothingOptions options;
  options.backend = &device;
  options.topology = trismooth::Topology::host;  // a device would find it with each call
  SmoothingPlan plan(mesh.vertex_count(), mesh.indices(), {}, options);
  std::vector<double> xy = mesh.xy();
  plan.smooth(xy);
  device.fail_next_at(fakes::Failure::prepare);
  xy = mirrored;
  CHECK_THROWS_AS(plan.smooth(xy), trismooth::DeviceError);
  CHECK(xy == mirrored);
  device.fail_next_at(fakes::Failure::none);
  plan.smooth(xy);
  CHECK(xy == expected);
}

TEST_CASE("the time of preparing is that of the call which prepared") {
  const Mesh mesh = test_meshes::jittered_grid(30, 30, 0.3, 1);
  SmoothingPlan repeated = plan(mesh.vertex_count(), mesh.indices());
  std::vector<double> xy = mesh.xy();
  CHECK(repeated.smooth(xy).timings.prepare > 0);
  CHECK(repeated.smooth(xy).timings.prepare == 0);
  CHECK(repeated.smooth(xy).timings.prepare == 0);
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    xy[i] = -xy[i];
  }
  CHECK(repeated.smooth(xy).timings.prepare > 0);
  CHECK(repeated.smooth(xy).timings.prepare == 0);
}

TEST_CASE("a plan that has been moved from says so, and can be made anew") {
  const Mesh mesh = test_meshes::star(5);
  SmoothingPlan first = plan(mesh.vertex_count(), mesh.indices());
  SmoothingPlan second = std::move(first);
  std::vector<double> xy = mesh.xy();
  // NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move): that is the question
  CHECK_THROWS_AS(first.smooth(xy), std::logic_error);
  CHECK(xy == mesh.xy());
  first = plan(mesh.vertex_count(), mesh.indices());
  first.smooth(xy);
  CHECK(xy == smoothed(mesh));
}

}  // namespace trismooth::smooth_test
