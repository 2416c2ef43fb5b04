// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cuda_or_cpu.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/mesh_io/halfedge/triangle_mesh.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/mixed_meshes.h"
#include "support/test_meshes.h"

namespace trismooth::cuda_or_cpu_test {

using fakes::Failure;
using fakes::FakeBackend;

constexpr std::int32_t grid_columns = 12;
constexpr std::int64_t vertices = 144;
constexpr std::int64_t free_vertices = 100;

CudaSupport support(const FakeBackend& backend, std::string problem = {}) {
  return {&backend, true, [problem = std::move(problem)] { return problem; }, {}};
}

struct Smoothed {
  SmoothingResult result;
  std::vector<double> xy;
};

Smoothed smooth_with(const trismooth::Backend* backend, trismooth::Topology topology = trismooth::Topology::host) {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(grid_columns, grid_columns, 0.45, 3);
  SmoothingOptions options;
  options.backend = backend;
  options.topology = topology;
  Smoothed smoothed{{}, mesh.xy()};
  smoothed.result = trismooth::smooth(trismooth::xy_points(smoothed.xy), mesh.indices(), {}, options);
  return smoothed;
}

TEST_CASE("from as many free vertices on as it is told, auto takes CUDA") {
  const FakeBackend cuda;
  const CudaOrCpu just_large(support(cuda), trismooth::cpu_backend(), free_vertices);
  const Smoothed by_cuda = smooth_with(&just_large);
  CHECK(by_cuda.result.backend == "cuda");
  CHECK(by_cuda.result.backend_note.empty());
  CHECK(by_cuda.result.free_vertices == free_vertices);
  CHECK(cuda.smoothed == 1);

  const CudaOrCpu too_small(support(cuda), trismooth::cpu_backend(), free_vertices + 1);
  const Smoothed by_cpu = smooth_with(&too_small);
  CHECK(by_cpu.result.backend == "cpu");
  CHECK(by_cpu.result.backend_note.empty());  // as everybody expects
  CHECK(cuda.prepared == 1);
  CHECK(by_cpu.xy == by_cuda.xy);
}

TEST_CASE("a small mesh asks no driver") {
  const FakeBackend cuda;
  const CudaOrCpu automatic({&cuda, true, []() -> std::string { throw std::logic_error("asked"); }, {}});
  CHECK(smooth_with(&automatic, trismooth::Topology::device).result.backend == "cpu");
}

TEST_CASE("a device is started for a large mesh alone") {
  const FakeBackend cuda;
  int asked = 0;
  const CudaOrCpu automatic({&cuda, true, [&asked] { return ++asked, std::string(); }, {}}, trismooth::cpu_backend(),
                            vertices);
  automatic.start(vertices - 1);
  CHECK(asked == 0);
  automatic.start(vertices);
  CHECK(asked == 1);
  CudaOrCpu({}).start(std::numeric_limits<std::int64_t>::max());  // none to start
}

TEST_CASE("without a device, or without CUDA in the build, auto smooths on the CPU and says why") {
  const FakeBackend cuda;
  const CudaOrCpu no_device(support(cuda, "cudaErrorNoDevice (no CUDA-capable device is detected)"),
                            trismooth::cpu_backend(), 1);
  const Smoothed by_cpu = smooth_with(&no_device);
  CHECK(by_cpu.result.backend == "cpu");
  CHECK(by_cpu.result.backend_note == "no CUDA device: cudaErrorNoDevice (no CUDA-capable device is detected)");
  CHECK(cuda.prepared == 0);
  CHECK(by_cpu.xy == smooth_with(nullptr).xy);

  const CudaOrCpu not_built({}, trismooth::cpu_backend(), 1);
  CHECK(smooth_with(&not_built).result.backend == "cpu");
}

TEST_CASE("where the device fails, the CPU does the whole work, to the same bits, and the note names the error") {
  const Failure failure = GENERATE(Failure::prepare, Failure::smooth);
  const FakeBackend cuda(failure);
  const CudaOrCpu automatic(support(cuda), trismooth::cpu_backend(), 1);
  const Smoothed fallen_back = smooth_with(&automatic);
  const Smoothed expected = smooth_with(nullptr);
  CHECK(fallen_back.result.backend == "cpu");
  CHECK(fallen_back.result.backend_note == "CUDA failed: cudaErrorMemoryAllocation (out of memory) from a test");
  CHECK(fallen_back.result.sweeps == expected.result.sweeps);
  CHECK(fallen_back.result.moved_vertices == expected.result.moved_vertices);
  CHECK(fallen_back.xy == expected.xy);
}

TEST_CASE("a device that failed once is not asked again by the same plan") {
  const FakeBackend cuda(Failure::smooth);
  const CudaOrCpu automatic(support(cuda), trismooth::cpu_backend(), 1);
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(grid_columns, grid_columns, 0.45, 3);
  SmoothingOptions options;
  options.backend = &automatic;
  trismooth::SmoothingPlan plan(mesh.vertex_count(), mesh.indices(), {}, options);
  for (int step = 0; step < 3; ++step) {
    std::vector<double> xy = mesh.xy();
    CHECK_FALSE(plan.smooth(xy).backend_note.empty());
    CHECK(xy == smooth_with(nullptr).xy);
  }
  CHECK(cuda.smoothed == 1);
}

TEST_CASE("meshes with quadrilaterals go to CUDA by their size as well, and to the CPU where it fails") {
  const mixed_meshes::MixedMesh mesh(11, 11, 0.3, 3);
  SmoothingOptions options;
  options.target_quality = 0.99;  // so that elements are needed beside the rings
  options.max_sweeps = 20;
  std::vector<double> expected = mesh.xy();
  smooth(xy_points(expected), mesh.elements, options);
  const auto smoothed = [&](const FakeBackend& cuda, std::int64_t large) {
    const CudaOrCpu automatic(support(cuda), trismooth::cpu_backend(), large);
    options.backend = &automatic;
    Smoothed found{{}, mesh.xy()};
    found.result = smooth(xy_points(found.xy), mesh.elements, options);
    CHECK(found.xy == expected);
    return found.result;
  };
  const FakeBackend cuda;
  CHECK(smoothed(cuda, free_vertices + 1).backend == "cpu");
  CHECK(cuda.prepared == 0);
  const SmoothingResult by_cuda = smoothed(cuda, free_vertices);
  CHECK(by_cuda.backend == "cuda");
  CHECK(by_cuda.backend_note.empty());
  for (const Failure failure : {Failure::prepare, Failure::smooth}) {
    const FakeBackend failing(failure);
    const SmoothingResult fallen_back = smoothed(failing, 1);
    CHECK(fallen_back.backend == "cpu");
    CHECK(fallen_back.backend_note == "CUDA failed: cudaErrorMemoryAllocation (out of memory) from a test");
  }
}

TEST_CASE("auto has rings found by the device where the mesh is large enough and the device can") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(grid_columns, grid_columns, 0.45, 3);
  SmoothingOptions options;
  options.topology = trismooth::Topology::device;
  const auto find = [&](const CudaOrCpu& automatic) {
    return automatic.find_rings(mesh.points, mesh.triangles, {}, options);
  };
  const FakeBackend cuda;
  CHECK(find(CudaOrCpu(support(cuda), trismooth::cpu_backend(), vertices)));
  CHECK_FALSE(find(CudaOrCpu(support(cuda), trismooth::cpu_backend(), vertices + 1)));
  CHECK_FALSE(find(CudaOrCpu(support(cuda, "cudaErrorNoDevice"), trismooth::cpu_backend(), 1)));
  CHECK(cuda.rings_found == 1);
  const FakeBackend failing(Failure::rings);
  const auto by_host = find(CudaOrCpu(support(failing), trismooth::cpu_backend(), 1));
  REQUIRE(by_host);
  CHECK(failing.rings_found == 1);
  CHECK(by_host->note == "the CPU found the rings: CUDA failed: cudaErrorMemoryAllocation (out of memory) from a test");
  CHECK(by_host->rings.neighbours == cuda.find_rings(mesh.points, mesh.triangles, {}, options)->rings.neighbours);
}

constexpr const char* rings_note =
    "the CPU found the rings: CUDA failed: cudaErrorMemoryAllocation (out of memory) from a test";

/// A grid of the halfedge kind, smoothed as programs with such a mesh do. It is tilted: of others the device keeps all.
SmoothingResult smooth_halfedges(const CudaOrCpu& automatic, std::int32_t columns) {
  trismooth::TriangleMesh mesh;
  const test_meshes::Mesh grid = test_meshes::jittered_grid(columns, 8, 0.45, 3);
  for (const auto& p : grid.points) {
    mesh.add_vertex({p.x, p.y, p.x});
  }
  for (const auto& [a, b, c] : grid.triangles) {
    mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c));
  }
  SmoothingOptions options;
  options.threads = 1;
  options.topology = trismooth::Topology::device;
  options.backend = &automatic;
  return trismooth::smooth(mesh, options);
}

TEST_CASE("where the device fails to find the rings of a mesh, its smoothing says so, and no other mesh's") {
  const FakeBackend cuda(Failure::rings, 8 * 9);
  const CudaOrCpu automatic(support(cuda), trismooth::cpu_backend(), 1);
  for (int round = 0; round < 2; ++round) {
    const SmoothingResult result = smooth_halfedges(automatic, 9);
    CHECK(result.backend == "cuda");
    CHECK(result.backend_note == rings_note);
    CHECK(smooth_halfedges(automatic, 10).backend_note.empty());
  }
  // Nor where one mesh comes between the two steps of another.
  const test_meshes::Mesh failing = test_meshes::jittered_grid(9, 8, 0.45, 3);
  const test_meshes::Mesh other = test_meshes::jittered_grid(10, 8, 0.45, 3);
  SmoothingOptions options;
  options.topology = trismooth::Topology::device;
  options.backend = &automatic;
  trismooth::Workers workers(1);
  const auto found = trismooth::rings_for(options, failing.points, failing.triangles, {}, [&] {
    return trismooth::find_mesh_rings(failing.points, failing.triangles, {}, workers);
  });
  CHECK(found.note == rings_note);
  std::vector<double> xy = other.xy();
  CHECK(trismooth::smooth(trismooth::xy_points(xy), other.indices(), {}, options).backend_note.empty());
}

TEST_CASE("meshes of several threads at a time get their own notes") {
  const FakeBackend cuda(Failure::rings, 8 * 9);
  const CudaOrCpu automatic(support(cuda), trismooth::cpu_backend(), 1);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round) {
        const bool fails = (i + round) % 2 == 0;
        const std::string note = smooth_halfedges(automatic, fails ? 9 : 10).backend_note;
        wrong += note == (fails ? rings_note : "") ? 0 : 1;
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  CHECK(wrong == 0);
}

TEST_CASE("starting the device is part of the first call's time alone") {
  const FakeBackend cuda(Failure::no_time);
  const CudaOrCpu automatic({&cuda,
                             true,
                             []() -> std::string {
                               std::this_thread::sleep_for(std::chrono::milliseconds(2));
                               return {};
                             },
                             {}},
                            trismooth::cpu_backend(), 1);
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(grid_columns, grid_columns, 0.45, 3);
  SmoothingOptions options;
  options.backend = &automatic;
  trismooth::SmoothingPlan plan(mesh.vertex_count(), mesh.indices(), {}, options);
  std::vector<double> xy = mesh.xy();
  CHECK(plan.smooth(xy).timings.prepare >= 2);
  CHECK(plan.smooth(xy).timings.prepare == 0);
}

}  // namespace trismooth::cuda_or_cpu_test
