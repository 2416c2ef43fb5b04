// SPDX-License-Identifier: BSD-3-Clause
// What callers hand over to the CUDA backend: plans used again, meshes in device memory, arrays of the host in every
// form, and what is refused.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/rounding.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "cpu_comparison.h"
#include "support/test_meshes.h"

using namespace trismooth;
using namespace cpu_comparison;
using test_meshes::Mesh;

namespace {

/// Occupies device memory until only `left` bytes or less are free.
class Hoard {
 public:
  explicit Hoard(std::size_t left) {
    cuda::give_memory_back();
    for (std::size_t piece = std::size_t{1} << 36U; piece >= (std::size_t{1} << 21U);) {
      std::size_t free = 0;
      std::size_t total = 0;
      cudaMemGetInfo(&free, &total);
      void* memory = nullptr;
      if (free > left + piece && cudaMalloc(&memory, piece) == cudaSuccess) {
        pieces_.push_back(memory);
      } else {
        cudaGetLastError();
        piece /= 2;
      }
    }
  }
  Hoard(const Hoard&) = delete;
  Hoard& operator=(const Hoard&) = delete;
  ~Hoard() {
    for (void* memory : pieces_) {
      cudaFree(memory);
    }
  }

 private:
  std::vector<void*> pieces_;
};

}  // namespace

TEST_CASE("a plan smooths new coordinates, and a mirrored mesh, as the CPU's plan does") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(15, 12, 0.45, 6), 3);
  for (const Topology topology : {Topology::host, Topology::device}) {
    SmoothingOptions options;
    SmoothingPlan expected = plan(mesh.vertex_count(), mesh.indices(), {}, options);
    options.backend = &cuda::backend();
    options.topology = topology;
    SmoothingPlan found = plan(mesh.vertex_count(), mesh.indices(), {}, options);
    for (const double factor : {1.0, 0.5, -1.0, -3.0, 2.0}) {
      std::vector<double> xy = mesh.xy();
      for (std::size_t i = 0; i < xy.size(); i += 2) {
        xy[i] *= factor;
      }
      Run by_cpu{xy, {}};
      Run by_cuda{xy, {}};
      by_cpu.result = expected.smooth(by_cpu.xy);
      by_cuda.result = found.smooth(by_cuda.xy);
      CAPTURE(factor);
      require_same(by_cuda, by_cpu);
    }
  }
}

TEST_CASE("meshes in device memory are smoothed on the caller's stream") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(25, 20, 0.45, 6), 3);
  const Run expected = run(mesh, {});
  cuda::Context context;
  cuda::DeviceBuffer<std::int32_t> triangles(context, mesh.indices());
  cuda::DeviceBuffer<double> xy(context, mesh.xy());
  std::vector<std::uint8_t> fixed(mesh.points.size());
  fixed[200] = 1;
  cuda::DeviceBuffer<std::uint8_t> device_fixed(context, fixed);
  cuda::DeviceMesh device_mesh{
      mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()), triangles.data(), {}};
  for (const Execution execution : built_executions()) {
    SmoothingOptions options;
    options.execution = execution;
    xy.upload(mesh.xy());
    Run found{mesh.xy(), {}};
    found.result = cuda::smooth(device_mesh, xy.data(), options, context.stream());
    xy.download(found.xy);
    require_same(found, expected);
  }
  SECTION("with constraints, again and again") {
    device_mesh.constraints.fixed = device_fixed.data();
    const Run held = run(mesh, {}, {.fixed = fixed});
    cuda::Plan plan(device_mesh, {}, context.stream());
    for (int i = 0; i < 3; ++i) {
      xy.upload(mesh.xy());
      Run found{mesh.xy(), {}};
      found.result = plan.smooth(xy.data());
      xy.download(found.xy);
      require_same(found, held);
    }
  }
  SECTION("in float") {
    std::vector<float> floats;
    Mesh rounded = mesh;
    for (auto& p : rounded.points) {
      floats.insert(floats.end(), {static_cast<float>(p.x), static_cast<float>(p.y)});
      p = {rounded_to_float32(p.x), rounded_to_float32(p.y)};
    }
    const Run stored = run(rounded, {}, {}, Storage::float32);
    cuda::DeviceBuffer<float> device_floats(context, floats);
    cuda::smooth(device_mesh, device_floats.data(), {}, context.stream());
    device_floats.download(floats);
    for (std::size_t i = 0; i < floats.size(); ++i) {
      CAPTURE(i);
      REQUIRE(static_cast<double>(floats[i]) == stored.xy[i]);
    }
  }
}

TEST_CASE("empty meshes, isolated vertices and hubs are smoothed like any other") {
  require_cpu_results({}, {});
  require_cpu_results({{{0, 0}, {1, 1}, {2, 0}}, {}}, {});
  require_cpu_results(test_meshes::bow_tie(), {});
  require_cpu_results(test_meshes::star(5000), {});
  SmoothingOptions swap;
  swap.form = Form::swap;
  require_cpu_results(test_meshes::star(5000), swap);
}

TEST_CASE("a mesh that is none is refused with the host's message, and nothing changes") {
  const Mesh mesh = test_meshes::jittered_grid(5, 5, 0.2, 1);
  const auto message = [](const auto& function) -> std::string {
    try {
      function();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "no error";
  };
  SmoothingOptions options;
  SmoothingOptions device = on_cuda();
  device.topology = Topology::device;
  Mesh out_of_range = mesh;
  out_of_range.triangles[3][1] = 25;
  CHECK(message([&] { run(out_of_range, device); }) == message([&] { run(out_of_range, options); }));
  Mesh infinite = mesh;
  infinite.points[7].y = std::numeric_limits<double>::infinity();
  CHECK(message([&] { run(infinite, device); }) == message([&] { run(infinite, options); }));
  std::vector<double> too_short(48);
  CHECK(message([&] { plan(25, mesh.indices(), {}, device).smooth(too_short); }) ==
        message([&] { plan(25, mesh.indices(), {}, options).smooth(too_short); }));
  const std::vector<std::int32_t> no_vertex{99};
  CHECK(message([&] { run(mesh, device, {.fixed_ids = no_vertex}); }) ==
        message([&] { run(mesh, options, {.fixed_ids = no_vertex}); }));
}

TEST_CASE("pointers that no kernel could use are refused by name before one runs, and the device goes on") {
  const Mesh mesh = test_meshes::jittered_grid(12, 12, 0.4, 1);
  const auto triangle_count = static_cast<std::int32_t>(mesh.triangles.size());
  cuda::Context context;
  const cuda::DeviceBuffer<std::int32_t> triangles(context, mesh.indices());
  // Room for one number more in front.
  std::vector<double> shifted = mesh.xy();
  shifted.insert(shifted.begin(), 0.0);
  cuda::DeviceBuffer<double> xy(context, shifted);
  cuda::DeviceBuffer<float> floats(context, std::vector<float>(shifted.begin(), shifted.end()));
  std::vector<double> of_host = mesh.xy();
  const cuda::DeviceMesh view{mesh.vertex_count(), triangle_count, triangles.data(), {}};
  cuda::Plan plan(view, {}, context.stream());
  const auto refusal = [](const auto& function) -> std::string {
    try {
      function();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  const std::string double_message = "xy is not aligned to 16 bytes, as it must be on a device";
  const std::string float_message = "xy is not aligned to 8 bytes, as it must be on a device";
  const std::string host_message = " points to memory of the host, not of a device";
  CHECK(refusal([&] { plan.smooth(xy.data() + 1); }) == double_message);
  CHECK(refusal([&] { plan.smooth(floats.data() + 1); }) == float_message);
  CHECK(refusal([&] { cuda::smooth(view, xy.data() + 1, {}, context.stream()); }) == double_message);
  CHECK(refusal([&] { plan.smooth(static_cast<double*>(nullptr)); }) == "xy is a null pointer");
  CHECK(refusal([&] { plan.smooth(static_cast<float*>(nullptr)); }) == "xy is a null pointer");
  CHECK(refusal([&] { cuda::smooth(view, static_cast<float*>(nullptr)); }) == "xy is a null pointer");
  int reads_host_memory = 0;
  REQUIRE(cudaDeviceGetAttribute(&reads_host_memory, cudaDevAttrPageableMemoryAccess, 0) == cudaSuccess);
  if (reads_host_memory == 0) {
    alignas(16) static double pageable[288];
    CHECK(refusal([&] { plan.smooth(pageable); }) == "xy" + host_message);
    const auto indices = mesh.indices();
    CHECK(refusal([&] {
            cuda::Plan({mesh.vertex_count(), triangle_count, indices.data(), {}}, {});
          }) == "DeviceMesh::elements" + host_message);
    const std::vector<std::uint8_t> flags(mesh.points.size());
    cuda::DeviceMesh held = view;
    held.constraints.fixed = flags.data();
    CHECK(refusal([&] { cuda::Plan(held, {}); }) == "DeviceConstraints::fixed" + host_message);
  }
  CHECK(refusal([&] {
          const auto* const odd =
              reinterpret_cast<const std::int32_t*>(reinterpret_cast<const std::byte*>(triangles.data()) + 2);
          cuda::Plan({mesh.vertex_count(), triangle_count, odd, {}}, {});
        }) == "DeviceMesh::elements is not aligned to 4 bytes, as it must be on a device");
  CHECK(refusal([&] {
          cuda::Plan({mesh.vertex_count(), triangle_count, nullptr, {}}, {});
        }) == "DeviceMesh::elements is a null pointer");
  // Nobody has run into anything: the same plan and stream go on. Two numbers further on is aligned.
  shifted.insert(shifted.begin(), 0.0);
  cuda::DeviceBuffer<double> aligned(context, shifted);
  Run found{mesh.xy(), plan.smooth(aligned.data() + 2)};
  std::vector<double> all(shifted.size());
  aligned.download(all);
  found.xy.assign(all.begin() + 2, all.end());
  require_same(found, run(mesh, {}));
  // Page-locked memory can be read there.
  void* memory = nullptr;
  REQUIRE(cudaMallocHost(&memory, of_host.size() * sizeof(double)) == cudaSuccess);
  auto* const locked = static_cast<double*>(memory);
  std::copy(of_host.begin(), of_host.end(), locked);
  plan.smooth(locked);
  CHECK(std::equal(found.xy.begin(), found.xy.end(), locked));
  REQUIRE(cudaFreeHost(memory) == cudaSuccess);
}

TEST_CASE("a plan that has been moved from says so, and one for device memory tells why vertices are fixed") {
  const Mesh mesh = test_meshes::jittered_grid(7, 6, 0.3, 1);
  cuda::Context context;
  const cuda::DeviceBuffer<std::int32_t> triangles(context, mesh.indices());
  cuda::DeviceBuffer<double> xy(context, mesh.xy());
  cuda::Plan first({mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()), triangles.data(), {}}, {},
                   context.stream());
  cuda::Plan second = std::move(first);
  // NOLINTBEGIN(bugprone-use-after-move,clang-analyzer-cplusplus.Move): that is the question
  CHECK_THROWS_AS(first.smooth(xy.data()), std::logic_error);
  CHECK_THROWS_AS(first.smooth(static_cast<float*>(nullptr)), std::logic_error);
  CHECK_THROWS_AS(first.fixed(), std::logic_error);
  // NOLINTEND(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  second.smooth(xy.data());
  Workers workers(1);
  CHECK(second.fixed() == find_mesh_rings(mesh.points, mesh.triangles, {}, workers).fixed);
}

TEST_CASE("arrays of the host in every form are the CPU's bits where the device finds the topology") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(30, 30, 0.45, 6), 3);
  std::vector<std::array<double, 3>> triples;
  std::vector<std::array<float, 2>> floats;
  for (const auto& p : mesh.points) {
    triples.push_back({p.x, p.y, -2});
    floats.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  }
  const auto indices = mesh.indices();
  const std::vector<std::size_t> wide(indices.begin(), indices.end());
  auto expected_triples = triples;
  auto expected_floats = floats;
  smooth(expected_triples, wide);
  smooth(expected_floats, wide);
  SmoothingOptions options = on_cuda();
  options.topology = Topology::device;
  smooth(triples, wide, {}, options);
  smooth(floats, wide, {}, options);
  CHECK(triples == expected_triples);
  CHECK(floats == expected_floats);
  // A height that only an unused vertex does not share, and one that is wrong.
  triples.push_back({0, 0, 5});
  CHECK_NOTHROW(smooth(triples, wide, {}, options));
  triples.front()[2] = 5;
  CHECK_THROWS_AS(smooth(triples, wide, {}, options), MeshError);
}

TEST_CASE("the time of preparing on the device is that of the call which prepared") {
  const Mesh mesh = test_meshes::jittered_grid(60, 60, 0.4, 1);
  SmoothingOptions options = on_cuda();
  options.topology = Topology::host;  // the device finds the orientation that the points of every call give
  SmoothingPlan repeated = plan(mesh.vertex_count(), mesh.indices(), {}, options);
  std::vector<double> xy = mesh.xy();
  CHECK(repeated.smooth(xy).timings.prepare > 0);
  CHECK(repeated.smooth(xy).timings.prepare == 0);
}

TEST_CASE("too little device memory is an error that says how much is needed, and the next mesh is smoothed") {
  const Mesh large = test_meshes::jittered_grid(2000, 1000, 0.3, 1);
  for (const Topology topology : {Topology::host, Topology::device}) {
    SmoothingOptions options = on_cuda();
    options.topology = topology;
    std::vector<double> xy = large.xy();
    {
      const Hoard hoard(std::size_t{40} << 20U);
      std::string message;
      try {
        smooth(xy_points(xy), large.indices(), {}, options);
      } catch (const DeviceError& error) {
        message = error.what();
      }
      CHECK(message.find("cudaErrorMemoryAllocation") != std::string::npos);
      CHECK(message.find("MiB") != std::string::npos);
      CHECK(same_bits(xy, large.xy()));
    }
    require_cpu_results(test_meshes::star(20), {});
  }
}
