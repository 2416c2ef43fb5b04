// SPDX-License-Identifier: BSD-3-Clause
/// What an update of a vertex costs by the kinds of its elements, and how long a mesh of them takes to its stop: a
/// jittered grid of squares, of the triangles into which these are cut, and of both.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/smoothing/smooth.h"

#ifdef TRISMOOTH_HAS_CUDA
#include "trismooth/cuda/backend.h"
#endif

#include "run_reporting.h"

namespace {

using Elements = std::vector<trismooth::MixedElement>;

struct Grid {
  std::vector<trismooth::Point2<double>> points;
  Elements squares, triangles, both;

  explicit Grid(std::int32_t n) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> off(-0.3, 0.3);
    for (std::int32_t row = 0; row <= n; ++row) {
      for (std::int32_t column = 0; column <= n; ++column) {
        const bool is_inner = row > 0 && row < n && column > 0 && column < n;
        const double x = column + (is_inner ? off(random) : 0);
        points.push_back({x, row + (is_inner ? off(random) : 0)});
      }
    }
    for (std::int32_t row = 0; row < n; ++row) {
      for (std::int32_t column = 0; column < n; ++column) {
        const std::int32_t a = row * (n + 1) + column;
        const trismooth::MixedElement square{a, a + 1, a + n + 2, a + n + 1};
        squares.push_back(square);
        add_halves(square, triangles);
        if (random() % 2 == 0) {
          both.push_back(square);
        } else {
          add_halves(square, both);
        }
      }
    }
  }

  static void add_halves(const trismooth::MixedElement& square, Elements& to) {
    const auto& [a, b, c, d] = square;
    to.push_back({a, b, c, trismooth::no_corner});
    to.push_back({a, c, d, trismooth::no_corner});
  }
};

/// Nanoseconds of an update, the least of `runs`.
double update_ns(const Grid& grid, const Elements& elements, const trismooth::SmoothingOptions& options, int runs) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    auto points = grid.points;
    const trismooth::SmoothingResult result = trismooth::smooth(points, elements, options);
    least = std::min(least, 1e6 * result.timings.smooth / static_cast<double>(result.vertex_updates));
  }
  return least;
}

/// What smoothing to the stop takes, all of one call by a plan that is there.
struct ToTheStop {
  double ms = std::numeric_limits<double>::infinity();  ///< the least of `runs`
  std::int64_t sweeps = 0;
};

ToTheStop to_the_stop(const Grid& grid, const Elements& elements, const trismooth::SmoothingOptions& options,
                      int runs) {
  trismooth::SmoothingPlan plan = trismooth::plan(std::ssize(grid.points), elements, options);
  ToTheStop found;
  // The first call makes the mesh ready.
  for (int run = 0; run <= runs; ++run) {
    auto points = grid.points;
    const trismooth::SmoothingResult result = plan.smooth(points);
    found.sweeps = result.sweeps;
    if (run > 0) {
      found.ms = std::min(found.ms, result.timings.smooth + result.timings.commit);
    }
  }
  return found;
}

constexpr std::array methods{trismooth::Method::smart, trismooth::Method::laplacian, trismooth::Method::weighted,
                             trismooth::Method::mean_ratio};
constexpr std::array precisions{trismooth::Precision::double_precision, trismooth::Precision::single_precision};

void print_updates(const Grid& grid, trismooth::SmoothingOptions options, int runs) {
  options.evaluation = trismooth::Evaluation::all;
  options.tolerance = 0;
  options.max_sweeps = 12;
  fmt::print("| ns an update | triangles | quadrilaterals | | both | |\n|---|---|---|---|---|---|\n");
  for (const trismooth::Precision precision : precisions) {
    for (const trismooth::Method method : methods) {
      options.method = method;
      options.precision = precision;
      const double triangles = update_ns(grid, grid.triangles, options, runs);
      const double squares = update_ns(grid, grid.squares, options, runs);
      const double both = update_ns(grid, grid.both, options, runs);
      fmt::print("| {}, {} | {:.3f} | {:.3f} | {:.2f} | {:.3f} | {:.2f} |\n", to_string(method), to_string(precision),
                 triangles, squares, squares / triangles, both, both / triangles);
    }
  }
}

void print_stops(const Grid& grid, trismooth::SmoothingOptions options, int runs) {
  fmt::print("\n| ms to the stop (sweeps) | triangles | quadrilaterals | both |\n|---|---|---|---|\n");
  for (const trismooth::Precision precision : precisions) {
    for (const trismooth::Method method : methods) {
      options.method = method;
      options.precision = precision;
      fmt::print("| {}, {} |", to_string(method), to_string(precision));
      for (const Elements* const elements : {&grid.triangles, &grid.squares, &grid.both}) {
        const ToTheStop found = to_the_stop(grid, *elements, options, runs);
        fmt::print(" {:.2f} ({}) |", found.ms, found.sweeps);
      }
      fmt::print("\n");
    }
  }
}

int run(int argc, char** argv) {
  CLI::App app(
      "Measures what an update of a vertex of triangles, of quadrilaterals and of both costs, and smoothing to the "
      "stop.");
  std::int32_t side = 500;
  int threads = 1;
  int runs = 9;
  bool on_cuda = false;
  bool stops = false;
  trismooth::SmoothingOptions options;
  app.add_option("--side", side, "squares along a side of the grid")->capture_default_str();
  app.add_option("--threads", threads)->capture_default_str();
  app.add_option("--runs", runs)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_flag("--cuda", on_cuda, "on the GPU");
  app.add_flag(
      "--form-a", [&](std::int64_t) { options.form = trismooth::Form::swap; }, "form a in place of form b");
  app.add_flag("--stops", stops, "smoothing to the stop as well");
  CLI11_PARSE(app, argc, argv);
  options.threads = threads;
  options.untangle = trismooth::Untangle::off;
  options.layers = trismooth::Layers::smooth;
  if (on_cuda) {
#ifdef TRISMOOTH_HAS_CUDA
    options.backend = &trismooth::cuda::backend();
#else
    fmt::print(stderr, "error: this build has no CUDA\n");
    return 2;
#endif
  }
  const Grid grid(side);
  print_updates(grid, options, runs);
  if (stops) {
    print_stops(grid, options, runs);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("element_kinds", run, argc, argv);
}
