// SPDX-License-Identifier: BSD-3-Clause
// How long a step takes of a mesh that follows its boundary: a square rotor that turns in a round hole.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/base/machine/stopwatch.h"
#ifdef TRISMOOTH_HAS_CUDA
#include <cuda_runtime_api.h>

#include "trismooth/cuda/moving_mesh.h"
#endif
#include "trismooth/smoothing/moving_mesh.h"

#include "run_reporting.h"
#include "support/rotor.h"

namespace {

using namespace trismooth;

/// The same for the same bits of all points.
std::uint64_t hash_of(const std::vector<Point2<double>>& points) {
  std::uint64_t hash = 0;
  for (const Point2<double>& p : points) {
    for (const double x : {p.x, p.y}) {
      hash = hash * 1099511628211U + std::bit_cast<std::uint64_t>(x);
    }
  }
  return hash;
}

/// Has the points follow, and says how long that took.
using Follow = std::function<FollowResult(std::vector<Point2<double>>& points, MovingStart start, double& seconds)>;

Follow follow_on_host(const test_meshes::Rotor& rotor, const SmoothingOptions& options) {
  const auto moving = std::make_shared<MovingMesh>(rotor.mesh.points, rotor.mesh.indices(), options);
  return [moving](std::vector<Point2<double>>& points, MovingStart start, double& seconds) {
    const Stopwatch watch;
    FollowResult result = moving->follow(points, start);
    seconds = watch.seconds();
    return result;
  };
}

#ifdef TRISMOOTH_HAS_CUDA
/// Of points in device memory: the time is without the way there and back.
Follow follow_on_device(const test_meshes::Rotor& rotor, const SmoothingOptions& options) {
  const auto moving =
      std::make_shared<cuda::MovingMesh>(rotor.mesh.points, rotor.mesh.indices(), Constraints{}, options);
  const std::size_t bytes = rotor.mesh.points.size() * sizeof(Point2<double>);
  void* memory = nullptr;
  if (cudaMalloc(&memory, bytes) != cudaSuccess) {
    throw std::runtime_error("no device memory");
  }
  const std::shared_ptr<double> xy(static_cast<double*>(memory), [](double* pointer) { cudaFree(pointer); });
  return [moving, xy, bytes](std::vector<Point2<double>>& points, MovingStart start, double& seconds) {
    cudaMemcpy(xy.get(), points.data(), bytes, cudaMemcpyHostToDevice);
    const Stopwatch watch;
    FollowResult result = moving->follow(xy.get(), start);
    seconds = watch.seconds();
    cudaMemcpy(points.data(), xy.get(), bytes, cudaMemcpyDeviceToHost);
    return result;
  };
}
#else
Follow follow_on_device(const test_meshes::Rotor& /*rotor*/, const SmoothingOptions& /*options*/) {
  throw std::runtime_error("built without CUDA");
}
#endif

int measure(int argc, char** argv) {
  CLI::App app("Times of the steps of a mesh that follows its boundary");
  std::vector<int> sizes{1, 7, 20};
  std::vector<int> threads{0};
  double degrees = 10;
  int steps = 5;
  bool on_device = false;
  app.add_option("--sizes", sizes, "N: 24 N rings of 96 N vertices");
  app.add_option("--threads", threads, "0: one for each core");
  app.add_option("--degrees", degrees, "that the rotor turns from the reference");
  app.add_option("--steps", steps, "of each kind, of an edge each; the least time counts");
  app.add_flag("--cuda", on_device, "points in memory of the current device");
  CLI11_PARSE(app, argc, argv);
  fmt::print("{:>9} {:>7} {:<10} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>7} {:>16}\n", "vertices", "threads", "start",
             "made s", "step s", "longest", "untangle", "sweeps s", "inverted", "sweeps", "hash");
  for (const int size : sizes) {
    const test_meshes::Rotor rotor(96 * size, 24 * size);
    for (const int count : threads) {
      SmoothingOptions options = moving_options();
      options.layers = Layers::smooth;
      options.threads = count;
      const Stopwatch making;
      const Follow follow = on_device ? follow_on_device(rotor, options) : follow_on_host(rotor, options);
      const double made = making.seconds();
      for (const MovingStart start : {MovingStart::reference, MovingStart::previous}) {
        double least = 0;
        double longest = 0;
        FollowResult result;  // of the least time
        std::vector<Point2<double>> points;
        for (int step = 0; step < steps; ++step) {
          const double angle = degrees * std::numbers::pi / 180 + 2 * std::numbers::pi / rotor.sectors * step;
          points = rotor.at(angle);
          double seconds = 0;
          FollowResult found = follow(points, start, seconds);
          longest = std::max(longest, seconds);
          if (step == 0 || seconds < least) {
            least = seconds;
            result = std::move(found);
          }
        }
        const SmoothingTimings& timings = result.smoothing.timings;
        fmt::print("{:>9} {:>7} {:<10} {:>8.3f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>9} {:>7} {:>16x}\n",
                   points.size(), count, to_string(start), made, least, longest, timings.untangle / 1e3,
                   timings.smooth / 1e3, result.smoothing.inverted, result.smoothing.sweeps, hash_of(points));
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("moving_mesh_steps", &measure, argc, argv);
}
