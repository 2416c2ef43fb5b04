// SPDX-License-Identifier: BSD-3-Clause
// Methods of the caller's own.
#include "trismooth/smoothing/proposal.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::proposal_test {

using test_meshes::Mesh;
using Place = std::optional<Point2<double>>;

Place mean_of_neighbours(const VertexNeighbourhood& around) {
  Point2<double> sum{0, 0};
  for (const Point2<double> p : around.neighbours) {
    sum = {sum.x + p.x, sum.y + p.y};
  }
  const auto count = static_cast<double>(around.neighbours.size());
  return Point2<double>{sum.x / count, sum.y / count};
}

/// The sum of the squared lengths of the edges of a vertex.
double squared_lengths(const VertexNeighbourhood& around) {
  double sum = 0;
  for (const Point2<double> p : around.neighbours) {
    sum += std::pow(p.x - around.position.x, 2) + std::pow(p.y - around.position.y, 2);
  }
  return sum;
}

std::vector<double> smoothed(const Mesh& mesh, const SmoothingOptions& options, SmoothingResult* result = nullptr) {
  std::vector<double> xy = mesh.xy();
  const SmoothingResult made = smooth(xy_points(xy), mesh.indices(), options);
  if (result != nullptr) {
    *result = made;
  }
  return xy;
}

// On lattices whose means are exact in any order the two round alike.
TEST_CASE("the mean of the neighbours as a proposal does what the methods of the library do") {
  const Mesh mesh = test_meshes::jittered_grid(30, 20, 0.4, 5);
  for (const auto& [accept, method] :
       {std::pair{Acceptance::better_worst, Method::smart}, std::pair{Acceptance::always, Method::laplacian}}) {
    for (const Form form : {Form::swap, Form::in_place}) {
      SmoothingOptions own{.proposal = {.place = &mean_of_neighbours, .accept = accept}, .form = form, .max_sweeps = 5};
      SmoothingOptions known{.method = method, .form = form, .max_sweeps = 5};
      const std::vector<double> found = smoothed(mesh, own);
      const std::vector<double> expected = smoothed(mesh, known);
      CHECK(found != mesh.xy());
      for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(found[i] == Approx(expected[i]).margin(1e-9));
      }
    }
  }
}

TEST_CASE("a proposal gives the same bits by any number of threads, in either form and precision, in a plan too") {
  const Mesh mesh = test_meshes::jittered_grid(60, 50, 0.45, 7);
  for (const Form form : {Form::swap, Form::in_place}) {
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
      SmoothingOptions options{.proposal = {.place = &mean_of_neighbours}, .form = form, .precision = precision};
      options.threads = 1;
      const std::vector<double> expected = smoothed(mesh, options);
      CHECK(expected != mesh.xy());
      for (const int threads : {2, 3, 7}) {
        options.threads = threads;
        CHECK(same_bits(smoothed(mesh, options), expected));
      }
      SmoothingPlan planned = plan(mesh.vertex_count(), mesh.indices(), options);
      for (int call = 0; call < 2; ++call) {
        std::vector<double> xy = mesh.xy();
        planned.smooth(xy);
        CHECK(same_bits(xy, expected));
      }
    }
  }
}

TEST_CASE("what a proposal is told of a vertex is the mesh around it, in the caller's numbers and coordinates") {
  Mesh mesh = test_meshes::jittered_grid(12, 9, 0.3, 3);
  for (auto& p : mesh.points) {
    p = {1000 + 50 * p.x, -300 + 50 * p.y};
  }
  std::atomic<int> visits{0};
  std::atomic<int> wrong{0};
  SmoothingOptions options;
  options.max_sweeps = 1;
  options.form = Form::swap;  // all is where it was
  options.proposal.place = [&](const VertexNeighbourhood& around) -> Place {
    ++visits;
    const auto lies_at = [&](std::int32_t v, Point2<double> p) {
      const auto& at = mesh.points[static_cast<std::size_t>(v)];
      return std::abs(at.x - p.x) < 1e-9 && std::abs(at.y - p.y) < 1e-9;
    };
    bool is_right = lies_at(around.vertex, around.position) && around.neighbours.size() == around.numbers.size();
    std::vector<Triangle> expected;
    for (const Triangle& t : mesh.triangles) {
      if (std::ranges::count(t, around.vertex) > 0) {
        expected.push_back(t);
      }
    }
    is_right = is_right && expected.size() == around.numbers.size();
    for (std::size_t i = 0; is_right && i < around.numbers.size(); ++i) {
      const std::size_t next = (i + 1) % around.numbers.size();
      const std::vector<std::int32_t> corners{around.vertex, around.numbers[i], around.numbers[next]};
      is_right =
          lies_at(around.numbers[i], around.neighbours[i]) &&
          std::ranges::any_of(expected, [&](const Triangle& t) { return std::ranges::is_permutation(t, corners); }) &&
          shape(around.position, around.neighbours[i], around.neighbours[next]) > 0;
    }
    wrong += is_right ? 0 : 1;
    return std::nullopt;
  };
  SmoothingResult result;
  CHECK(smoothed(mesh, options, &result) == mesh.xy());
  CHECK(visits == result.free_vertices);
  CHECK(wrong == 0);
  CHECK(result.stop_reason == StopReason::fixed_point);
}

TEST_CASE("a proposal that is accepted by its energy never raises it") {
  const Mesh mesh = test_meshes::star(7);
  SmoothingOptions options;
  options.guard = false;
  options.proposal = {.place = [](const VertexNeighbourhood& around) -> Place {
                        return Point2<double>{around.position.x + 0.01, around.position.y};
                      },
                      .accept = Acceptance::lower_energy,
                      .energy = &squared_lengths};
  std::vector<double> xy = mesh.xy();
  xy[0] = -0.2;
  smooth(xy_points(xy), mesh.indices(), options);
  // The mean of the corners is where the energy is least along x; no step of 0.01 leads down from near there.
  double mean = 0;
  for (std::size_t v = 1; v < mesh.points.size(); ++v) {
    mean += mesh.points[v].x / 7;
  }
  CHECK(xy[0] > -0.2);
  CHECK(std::abs(xy[0] - mean) <= 0.005 + 1e-9);
}

TEST_CASE("no triangle gets worse by a proposal that goes anywhere, and one that is no place changes nothing") {
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.2, 9);
  SmoothingOptions options;
  options.max_sweeps = 3;
  options.proposal.accept = Acceptance::always;
  options.proposal.place = [](const VertexNeighbourhood& around) -> Place {
    return Point2<double>{around.neighbours[0].x, around.neighbours[0].y};
  };
  SmoothingResult result;
  smoothed(mesh, options, &result);
  CHECK(result.inverted + result.degenerate == 0);
  for (const double nowhere : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    options.proposal.place = [nowhere](const VertexNeighbourhood&) -> Place { return Point2<double>{nowhere, 0}; };
    CHECK(same_bits(smoothed(mesh, options), mesh.xy()));
  }
}

TEST_CASE("a place that is farther out than the frame of the mesh is no place to go, rather than another one") {
  const Mesh mesh{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  for (const double x : {1.75, 10.0, 1e6, 1e300}) {
    for (const bool guard : {true, false}) {
      CAPTURE(x, guard);
      SmoothingOptions options;
      options.proposal.place = [x](const VertexNeighbourhood&) { return Point2<double>{x, 0.5}; };
      options.proposal.accept = Acceptance::always;
      options.max_sweeps = 1;
      options.guard = guard;
      std::vector<double> xy = mesh.xy();
      const SmoothingResult result = smooth(xy_points(xy), mesh.indices(), options);
      CHECK(xy[8] == (guard || x > 2 ? 0.5 : x));
      CHECK((result.reverted.empty() || result.reverted[0].position.x == x));
    }
  }
}

TEST_CASE("what a proposal throws, smooth() throws, and the points are untouched") {
  const Mesh mesh = test_meshes::jittered_grid(30, 30, 0.3, 1);
  std::vector<double> xy = mesh.xy();
  std::atomic<int> calls{0};
  SmoothingOptions options;
  options.proposal.place = [&](const VertexNeighbourhood& around) -> Place {
    if (++calls > 500) {
      throw std::runtime_error("enough");
    }
    return mean_of_neighbours(around);
  };
  CHECK_THROWS_WITH(smooth(xy_points(xy), mesh.indices(), options), "enough");
  CHECK(same_bits(xy, mesh.xy()));
}

TEST_CASE("proposals go with neither another method nor another backend, nor with vertices that slide") {
  const Mesh mesh = test_meshes::star(6);
  const auto refusal = [&](const SmoothingOptions& options, const Constraints& constraints = {}) -> std::string {
    std::vector<double> xy = mesh.xy();
    try {
      smooth(xy_points(xy), mesh.indices(), constraints, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  SmoothingOptions options;
  options.proposal.place = &mean_of_neighbours;
  CHECK(refusal(options).empty());
  options.backend = &cpu_backend();
  CHECK(refusal(options).empty());
  CHECK(refusal(options, {.slide = {.along = Slide::straight}}).find("slide") != std::string::npos);
  const fakes::FakeBackend device;
  options.backend = &device;
  CHECK(refusal(options) == "a proposal is a function of the host: the CPU backend alone takes it");
  options.backend = nullptr;
  options.method = Method::mean_ratio;
  CHECK(refusal(options) == "a proposal takes the place of the method: leave that as it is");
  options.method = Method::smart;
  options.proposal.accept = Acceptance::lower_energy;
  CHECK(refusal(options).find("needs an energy") != std::string::npos);
}

}  // namespace trismooth::proposal_test
