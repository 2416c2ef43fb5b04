// SPDX-License-Identifier: BSD-3-Clause
// Several devices of one process share a mesh out: the CPU's bits, whatever devices there are. A device that is named
// twice has two parts, so that one device is enough for most of it.

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "mixed_runs.h"
#include "properties/for_random_meshes.h"
#include "properties/in_parts.h"
#include "properties/smoothing_cases.h"
#include "smoothing_runs.h"
#include "support/distorted_meshes.h"
#include "support/mixed_meshes.h"

using namespace properties;

namespace cuda = trismooth::cuda;

namespace {

/// Lists of devices that this machine has.
std::vector<std::vector<int>> lists_of_devices() {
  std::vector<std::vector<int>> lists{{0}, {0, 0}, {0, 0, 0}};
  const auto count = static_cast<int>(cuda::survey_devices().devices.size());
  if (count > 1) {
    lists.insert(lists.end(), {{1}, {0, 1}, {1, 0}, {0, 1, 1}});
  }
  if (count > 2) {
    lists.emplace_back();
    for (int device = 0; device < count; ++device) {
      lists.back().push_back(device);
    }
  }
  return lists;
}

int current_device() {
  int device = -1;
  cudaGetDevice(&device);
  return device;
}

void check_random_meshes(std::int64_t count, bool slides) {
  for (const std::vector<int>& devices : lists_of_devices()) {
    CAPTURE(devices);
    const std::unique_ptr<trismooth::Backend> backend = cuda::backend_on(devices);
    for_random_meshes(count, [&](RandomMesh mesh) {
      return for_some_options(mesh, 1, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
        std::vector<double> lengths;
        draw_for_parts(mesh, options, lengths, random);
        if (slides) {
          mesh.slide = any_sliding(random);
        }
        const Storage storage = fits_float32(mesh) && random.below(4) == 0 ? Storage::float32 : Storage::float64;
        constexpr bool untangles = true;
        return difference_in_parts(mesh, options, storage, *backend, untangles);
      });
    });
    CHECK(current_device() == 0);
  }
}

}  // namespace

TEST_CASE("random meshes that devices share have the bits and figures of the CPU") {
  check_random_meshes(600, false);
}

TEST_CASE("what slides is the work of the first device, with the same bits") {
  check_random_meshes(60, true);
}

TEST_CASE("a large mesh that devices share has the bits of the CPU, by every method, form and precision") {
  const auto grid = distorted_meshes::displaced(160, 0.25, 7);
  for (std::uint64_t index = 0; index < combinations; ++index) {
    SmoothingOptions options = combination(index);
    options.threads = 0;
    options.max_sweeps = 40;
    CAPTURE(text_of(options));
    std::vector<double> expected = grid.xy();
    trismooth::smooth(trismooth::xy_points(expected), grid.indices(), options);
    for (const std::vector<int>& devices : lists_of_devices()) {
      CAPTURE(devices);
      const std::unique_ptr<trismooth::Backend> backend = cuda::backend_on(devices);
      options.backend = backend.get();
      std::vector<double> found = grid.xy();
      const SmoothingResult result = trismooth::smooth(trismooth::xy_points(found), grid.indices(), options);
      CHECK(difference(found, expected) == "");
      CHECK(result.backend == "cuda");
    }
  }
}

TEST_CASE(
    "meshes with quadrilaterals that devices share have the bits of the CPU, by every method, form and precision") {
  using mixed_meshes::MixedMesh;
  std::vector<MixedMesh> meshes = mixed_runs::random_meshes(20);
  meshes.emplace_back(160, 150, 0.4, 3);
  meshes.push_back(MixedMesh(60, 50, 0.4, 5, 0).listed_from_other_corners(7, true));
  for (const std::vector<int>& devices : lists_of_devices()) {
    const std::unique_ptr<trismooth::Backend> backend = cuda::backend_on(devices);
    for (const MixedMesh& mesh : meshes) {
      for (SmoothingOptions options : mixed_runs::all_ways(30)) {
        CAPTURE(devices, mesh.points.front()[0], mixed_runs::name_of(options));
        options.record_min_shape = mesh.elements.size() % 2 == 0;
        const auto expected = mixed_runs::run(mesh, options);
        options.backend = backend.get();
        const auto found = mixed_runs::run(mesh, options);
        CHECK(found.result.backend == "cuda");
        CHECK(found.result.quadrilaterals == expected.result.quadrilaterals);
        smoothing_runs::require_same(found, expected);
      }
    }
  }
}

TEST_CASE("quadrilaterals that are tangled, or slide, have the CPU's bits where devices share a mesh, and it is said") {
  const std::unique_ptr<trismooth::Backend> backend = cuda::backend_on(std::vector<int>{0, 0});
  const mixed_meshes::MixedMesh mesh(20, 15, 0.5, 4);
  SmoothingOptions options;
  options.untangle = trismooth::Untangle::on;
  const auto untangled = mixed_runs::run(mesh, options);
  REQUIRE(untangled.result.untangling->inverted_before > 0);
  trismooth::Constraints constraints;
  constraints.slide.along = trismooth::Slide::straight;
  const mixed_meshes::MixedMesh valid(20, 15, 0.2, 4);
  const auto slid = mixed_runs::run(valid, {}, constraints);
  options.backend = backend.get();
  const auto found = mixed_runs::run(mesh, options);
  CHECK(found.xy == untangled.xy);
  CHECK(found.result.backend_note == "the mesh has inverted elements, which the CPU untangles");
  SmoothingOptions shared;
  shared.backend = backend.get();
  const auto slid_there = mixed_runs::run(valid, shared, constraints);
  CHECK(slid_there.xy == slid.xy);
  CHECK(slid_there.result.backend_note == "vertices slide on one device, not on several");
}

TEST_CASE("two threads may smooth on the same devices at the same time") {
  const auto grid = distorted_meshes::displaced(60, 0.25, 3);
  SmoothingOptions options;
  std::vector<double> expected = grid.xy();
  trismooth::smooth(trismooth::xy_points(expected), grid.indices(), options);
  const std::unique_ptr<trismooth::Backend> backend = cuda::backend_on(lists_of_devices().back());
  options.backend = backend.get();
  std::array<std::string, 4> wrong;
  {
    std::vector<std::jthread> threads;
    for (std::string& own : wrong) {
      threads.emplace_back([&] {
        for (int times = 0; times < 5; ++times) {
          std::vector<double> found = grid.xy();
          trismooth::smooth(trismooth::xy_points(found), grid.indices(), options);
          own += difference(found, expected);
        }
      });
    }
  }
  CHECK(wrong == std::array<std::string, 4>{});
}

TEST_CASE("devices that are not there, or make no sense, are refused") {
  CHECK_THROWS_AS(cuda::backend_on(std::vector<int>{}), std::invalid_argument);
  CHECK_THROWS_AS(cuda::backend_on(std::vector<int>{0, -1}), std::invalid_argument);
  CHECK_THROWS_AS(cuda::backend_on(std::vector<int>{0, 1000}), trismooth::DeviceError);
  const std::unique_ptr<trismooth::Backend> backend = cuda::backend_on(std::vector<int>{0, 0});
  SmoothingOptions options;
  options.backend = backend.get();
  options.execution = trismooth::Execution::single_block;
  const auto grid = distorted_meshes::displaced(5, 0.3, 1);
  std::vector<double> xy = grid.xy();
  CHECK_THROWS_AS(trismooth::smooth(trismooth::xy_points(xy), grid.indices(), options), std::invalid_argument);
}
