// SPDX-License-Identifier: BSD-3-Clause
/// Times smooth() on arrays, for comparison with the same from Python (benchmarks/python_arrays.py): the meshes are the
/// same, and so are the options.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/smoothing/smooth.h"

#include "run_reporting.h"

namespace {

struct Mesh {
  std::vector<std::array<double, 2>> points;
  std::vector<trismooth::Triangle> triangles;
};

/// A grid of right triangles whose inner points are displaced by a hash of their numbers.
Mesh grid(std::int32_t columns, std::int32_t rows) {
  const auto offset = [](std::uint64_t number, std::uint64_t factor) {
    return static_cast<double>(number * factor % (std::uint64_t{1} << 32U)) / 4294967296.0 - 0.5;
  };
  Mesh mesh;
  for (std::int32_t j = 0; j <= rows; ++j) {
    for (std::int32_t i = 0; i <= columns; ++i) {
      const bool is_inner = i > 0 && i < columns && j > 0 && j < rows;
      const std::uint64_t number = mesh.points.size();
      mesh.points.push_back({i + (is_inner ? 0.7 * offset(number, 2654435761U) : 0),
                             j + (is_inner ? 0.7 * offset(number, 2246822519U) : 0)});
    }
  }
  const std::int32_t across = columns + 1;
  for (std::int32_t j = 0; j < rows; ++j) {
    for (std::int32_t i = 0; i < columns; ++i) {
      const std::int32_t first = j * across + i;
      mesh.triangles.push_back({first, first + 1, first + across + 1});
      mesh.triangles.push_back({first, first + across + 1, first + across});
    }
  }
  return mesh;
}

/// Milliseconds of each of `runs` runs of `calls` smoothings, each of fresh points, for one.
std::vector<double> times(const Mesh& mesh, const trismooth::SmoothingOptions& options, int runs, int calls) {
  std::vector<double> milliseconds;
  auto points = mesh.points;
  for (int run = 0; run < runs; ++run) {
    std::chrono::duration<double, std::milli> sum{0};
    for (int call = 0; call < calls; ++call) {
      std::ranges::copy(mesh.points, points.begin());
      const auto begin = std::chrono::steady_clock::now();
      trismooth::smooth(points, mesh.triangles, options);
      sum += std::chrono::steady_clock::now() - begin;
    }
    milliseconds.push_back(sum.count() / calls);
  }
  std::ranges::sort(milliseconds);
  return milliseconds;
}

int run(int argc, char** argv) {
  CLI::App app("Times smooth() on arrays of the caller's.");
  std::int32_t vertices = 1'000'000;
  int runs = 7;
  app.add_option("--vertices", vertices);
  app.add_option("--runs", runs);
  CLI11_PARSE(app, argc, argv);
  trismooth::SmoothingOptions options;
  options.method = trismooth::Method::mean_ratio;
  const auto middle = static_cast<std::size_t>(runs / 2);
  for (const int threads : {0, 1}) {
    options.threads = threads;
    const std::vector<double> ms = times(grid(3, 2), options, runs, 2000);
    std::cout << fmt::format("12 triangles{}: {:.1f} us ({:.1f} to {:.1f})\n", threads == 1 ? ", 1 thread" : "",
                             1e3 * ms[middle], 1e3 * ms.front(), 1e3 * ms.back());
  }
  options.threads = 0;
  const auto side = std::max(2, static_cast<std::int32_t>(std::lround(std::sqrt(vertices))) - 1);
  const Mesh mesh = grid(side, side);
  const std::vector<double> ms = times(mesh, options, runs, 1);
  std::cout << fmt::format("{} vertices on the CPU: {:.1f} ms ({:.1f} to {:.1f})\n", mesh.points.size(), ms[middle],
                           ms.front(), ms.back());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("flat_arrays", run, argc, argv);
}
