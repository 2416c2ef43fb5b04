// SPDX-License-Identifier: BSD-3-Clause
// Meshes that follow their boundary, on the device: the CPU's bits, and the same said of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/moving_mesh.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/moving_mesh.h"

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "properties/moved_boundary.h"
#include "support/refusal.h"
#include "support/rotor.h"

namespace cuda = trismooth::cuda;

using properties::RandomMesh;
using test_meshes::Point;
using test_meshes::Random;
using test_meshes::Rotor;
using trismooth::FollowResult;
using trismooth::Layers;
using trismooth::MovingMesh;
using trismooth::MovingStart;
using trismooth::SmoothingOptions;
using trismooth::TargetShape;

namespace {

constexpr double degree = std::numbers::pi / 180;

SmoothingOptions on_device(SmoothingOptions options) {
  options.backend = &cuda::backend();
  return options;
}

/// NaN is NaN.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

std::string difference(const FollowResult& found, const FollowResult& expected) {
  const auto& here = found.smoothing;
  const auto& there = expected.smoothing;
  if (here.inverted != there.inverted || here.degenerate != there.degenerate ||
      found.invalid_held != expected.invalid_held || found.invalid != expected.invalid) {
    return fmt::format("{} inverted, {} degenerate, {} held, not {}, {}, {}", here.inverted, here.degenerate,
                       found.invalid_held, there.inverted, there.degenerate, expected.invalid_held);
  }
  if (!same(found.min_relative_shape, expected.min_relative_shape) ||
      !same(found.mean_relative_shape, expected.mean_relative_shape) ||
      !same(found.largest_move, expected.largest_move)) {
    return fmt::format("shapes {}, {}, move {}, not {}, {}, {}", found.min_relative_shape, found.mean_relative_shape,
                       found.largest_move, expected.min_relative_shape, expected.mean_relative_shape,
                       expected.largest_move);
  }
  if (found.crossings != expected.crossings || found.overlaps != expected.overlaps) {
    return fmt::format("{} crossings, {} overlaps, not {}, {}", found.crossings.size(), found.overlaps.size(),
                       expected.crossings.size(), expected.overlaps.size());
  }
  if (here.sweeps != there.sweeps || here.moved_vertices != there.moved_vertices ||
      here.stop_reason != there.stop_reason || here.untangling.has_value() != there.untangling.has_value()) {
    return fmt::format("{} sweeps, {} moved, not {}, {}", here.sweeps, here.moved_vertices, there.sweeps,
                       there.moved_vertices);
  }
  return {};
}

}  // namespace

TEST_CASE("whatever the boundary does, a mesh follows it on the device to the CPU's bits") {
  properties::for_random_meshes(600, [](const RandomMesh& random) -> std::string {
    Random dice(random.seed);
    SmoothingOptions options = trismooth::moving_options();
    options.layers = dice.below(2) == 0 ? Layers::smooth : Layers::automatic;
    options.mean_ratio.target = dice.below(2) == 0 ? TargetShape::input : TargetShape::uniform;
    options.precision = dice.below(3) == 0 ? trismooth::Precision::single_precision : options.precision;
    options.form = dice.below(3) == 0 ? trismooth::Form::in_place : options.form;
    MovingMesh there(random.mesh.points, random.mesh.indices(), random.constraints(), options);
    MovingMesh here(random.mesh.points, random.mesh.indices(), random.constraints(), on_device(options));
    for (const std::uint64_t seed : {random.seed, random.seed + 1, random.seed}) {
      const MovingStart start = dice.below(2) == 0 ? MovingStart::reference : MovingStart::previous;
      const std::vector<Point> boundary = properties::moved_boundary(random, there.held(), seed);
      if (std::ranges::any_of(boundary, [](Point p) { return !std::isfinite(p.x) || !std::isfinite(p.y); })) {
        continue;  // of meshes as large as numbers are
      }
      std::vector<Point> expected = boundary;
      std::vector<Point> points = boundary;
      const FollowResult of_cpu = there.follow(expected, start);
      if (const std::string wrong = difference(here.follow(points, start), of_cpu); !wrong.empty()) {
        return wrong;
      }
      if (points != expected || here.points() != there.points()) {
        return "another mesh";
      }
    }
    return "";
  });
}

TEST_CASE("a rotor turns on the device as on the CPU, there and back, from the reference and from the last step") {
  const Rotor rotor(192, 40);
  SmoothingOptions options = trismooth::moving_options();
  options.layers = Layers::smooth;
  options.mean_ratio.target = GENERATE(TargetShape::input, TargetShape::uniform);
  MovingMesh there(rotor.mesh.points, rotor.mesh.indices(), options);
  MovingMesh here(rotor.mesh.points, rotor.mesh.indices(), on_device(options));
  for (const MovingStart start : {MovingStart::reference, MovingStart::previous}) {
    for (const double degrees : {2.0, 30.0, 150.0, 0.0}) {
      CAPTURE(degrees);
      std::vector<Point> expected = rotor.at(degrees * degree);
      std::vector<Point> points = expected;
      const FollowResult of_cpu = there.follow(expected, start);
      const FollowResult result = here.follow(points, start);
      CHECK(difference(result, of_cpu) == "");
      CHECK((points == expected));
      const bool was_tangled = of_cpu.smoothing.untangling->inverted_before > 0;
      CHECK(result.smoothing.backend == (was_tangled ? "cpu" : "cuda"));
    }
  }
}

TEST_CASE("numbers of float and heights follow on the device as on the CPU") {
  const Rotor rotor;
  std::vector<std::array<float, 3>> rest;
  for (const Point p : rotor.mesh.points) {
    rest.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 3.5F});
  }
  MovingMesh there(rest, rotor.mesh.indices());
  MovingMesh here(rest, rotor.mesh.indices(), on_device(trismooth::moving_options()));
  const std::vector<Point> turned = rotor.at(20 * degree);
  std::vector<std::array<float, 3>> expected = rest;
  for (std::size_t v = 0; v < expected.size(); ++v) {
    expected[v] = {static_cast<float>(turned[v].x), static_cast<float>(turned[v].y), 3.5F};
  }
  std::vector<std::array<float, 3>> points = expected;
  const FollowResult of_cpu = there.follow(expected);
  CHECK(difference(here.follow(points), of_cpu) == "");
  CHECK((points == expected));
}

TEST_CASE("a mesh on the device goes on from points that are given, and is what it was where a call ends early") {
  const Rotor rotor;
  MovingMesh first(rotor.mesh.points, rotor.mesh.indices(), on_device(trismooth::moving_options()));
  std::vector<Point> last = rotor.at(20 * degree);
  first.follow(last);
  std::vector<Point> expected = rotor.at(22 * degree);
  first.follow(expected, MovingStart::previous);

  SmoothingOptions options = on_device(trismooth::moving_options());
  bool is_over = false;
  options.cancel = [&is_over] { return is_over; };
  MovingMesh second(rotor.mesh.points, rotor.mesh.indices(), options);
  second.go_on_from(last);
  CHECK((second.points() == last));
  std::vector<Point> points = rotor.at(22 * degree);
  is_over = true;
  const FollowResult ended = second.follow(points, MovingStart::previous);
  CHECK(ended.smoothing.stop_reason == trismooth::StopReason::cancelled);
  CHECK((points == rotor.at(22 * degree)));
  CHECK((second.points() == last));
  is_over = false;
  second.follow(points, MovingStart::previous);
  CHECK((points == expected));
}

TEST_CASE("a step on the device that is taken back has not happened, and float may be asked for") {
  const Rotor rotor;
  cuda::Context context;
  cuda::MovingMesh here(rotor.mesh.points, rotor.mesh.indices(), {}, trismooth::moving_options(), context.stream());
  MovingMesh there(rotor.mesh.points, rotor.mesh.indices());
  CHECK_THROWS_AS(here.take_back(), std::logic_error);
  const auto step = [&](double degrees, trismooth::Storage storage) {
    std::vector<Point> expected = rotor.at(degrees * degree);
    cuda::DeviceBuffer<Point> points(context, expected);
    const FollowResult of_cpu = there.follow(expected, MovingStart::previous, storage);
    CHECK(difference(here.follow(&points.data()->x, MovingStart::previous, storage), of_cpu) == "");
    CHECK((here.points() == expected));
  };
  step(4, trismooth::Storage::float64);
  step(60, trismooth::Storage::float32);
  here.take_back();
  there.take_back();
  CHECK((here.points() == there.points()));
  CHECK_THROWS_AS(here.take_back(), std::logic_error);
  step(7, trismooth::Storage::float32);
}

TEST_CASE("a mesh follows its boundary on one device, not on several") {
  const Rotor rotor;
  const std::array<int, 2> twice{0, 0};
  const auto several = cuda::backend_on(twice);
  SmoothingOptions options = trismooth::moving_options();
  options.backend = several.get();
  CHECK(test_support::refusal([&] {
          const MovingMesh refused(rotor.mesh.points, rotor.mesh.indices(), options);
        }).find("on one device") != std::string::npos);
  const auto one = cuda::backend_on(std::array{0});
  options.backend = one.get();
  MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), options);
  MovingMesh there(rotor.mesh.points, rotor.mesh.indices());
  std::vector<Point> points = rotor.at(5 * degree);
  std::vector<Point> expected = points;
  moving.follow(points);
  there.follow(expected);
  CHECK((points == expected));
}

TEST_CASE("points in device memory follow where they are, on the caller's stream, double and float") {
  const Rotor rotor;
  cuda::Context context;
  cuda::MovingMesh here(rotor.mesh.points, rotor.mesh.indices(), {}, trismooth::moving_options(), context.stream());
  MovingMesh there(rotor.mesh.points, rotor.mesh.indices());
  CHECK(here.held() == there.held());
  for (const MovingStart start : {MovingStart::reference, MovingStart::previous}) {
    for (const double degrees : {8.0, 150.0, 20.0}) {
      CAPTURE(degrees);
      std::vector<Point> expected = rotor.at(degrees * degree);
      cuda::DeviceBuffer<Point> points(context, expected);
      const FollowResult of_cpu = there.follow(expected, start);
      CHECK(difference(here.follow(&points.data()->x, start), of_cpu) == "");
      CHECK((download(context, static_cast<const Point*>(points.data()), points.size()) == expected));
      CHECK((here.points() == expected));
    }
  }
  std::vector<std::array<float, 2>> expected;
  for (const Point p : rotor.at(-15 * degree)) {
    expected.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  }
  cuda::DeviceBuffer<std::array<float, 2>> points(context, expected);
  const FollowResult of_cpu = there.follow(expected);
  CHECK(difference(here.follow(points.data()->data()), of_cpu) == "");
  CHECK((download(context, static_cast<const std::array<float, 2>*>(points.data()), points.size()) == expected));
}

TEST_CASE("points in device memory that cannot follow are refused, and stay as they are") {
  const Rotor rotor;
  cuda::Context context;
  cuda::MovingMesh moving(rotor.mesh.points, rotor.mesh.indices(), {}, trismooth::moving_options(), context.stream());
  std::vector<Point> bad = rotor.at(8 * degree);
  CHECK(test_support::refusal([&] { moving.follow(&bad.front().x); }).find("xy") != std::string::npos);
  CHECK(test_support::refusal([&] { moving.follow(static_cast<double*>(nullptr)); }).find("xy") != std::string::npos);
  bad[5].y = std::numeric_limits<double>::quiet_NaN();
  cuda::DeviceBuffer<Point> points(context, bad);
  CHECK(test_support::refusal([&] { moving.follow(&points.data()->x); }).find("vertex 5") != std::string::npos);
  CHECK(same(download(context, static_cast<const Point*>(points.data()), points.size())[5].x, bad[5].x));
  CHECK((moving.points() == rotor.mesh.points));
}
