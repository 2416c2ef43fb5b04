// Where the backend's memory comes from, what it counts, and how the caller's arrays get there and back.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <thread>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/host_copy.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/test_meshes.h"

using namespace trismooth;
using test_meshes::Mesh;

namespace {

std::uint64_t reserved_bytes() {
  std::uint64_t bytes = 0;
  REQUIRE(cudaMemPoolGetAttribute(cuda::memory_pool(), cudaMemPoolAttrReservedMemCurrent, &bytes) == cudaSuccess);
  return bytes;
}

SmoothingResult smooth_on_device(const Mesh& mesh) {
  SmoothingOptions options;
  options.backend = &cuda::backend();
  options.topology = Topology::device;
  std::vector<double> xy = mesh.xy();
  return smooth(xy, mesh.indices(), {}, options);
}

std::vector<std::int32_t> numbers(std::size_t count) {
  std::vector<std::int32_t> values(count);
  std::iota(values.begin(), values.end(), 7);
  return values;
}

/// There and back again.
void require_round_trip(cuda::HostCopier& copier, cuda::Context& context, const std::vector<std::int32_t>& values) {
  cuda::DeviceBuffer<std::int32_t> device = copier.uploaded(std::span(values));
  std::vector<std::int32_t> back(values.size());
  copier.download(std::span(back), device);
  REQUIRE(back == values);
  // What was uploaded in pieces is what CUDA itself brings back, and the other way round.
  std::vector<std::int32_t> straight(values.size());
  device.download(straight);
  REQUIRE(straight == values);
  device.fill_bytes(0);
  device.upload(values);
  std::ranges::fill(back, 0);
  copier.download(std::span(back), device);
  REQUIRE(back == values);
  context.synchronize();
}

}  // namespace

TEST_CASE("memory of a mesh serves the next one, and is given back when asked for") {
  const Mesh mesh = test_meshes::jittered_grid(400, 300, 0.3, 1);
  smooth_on_device(mesh);
  const std::uint64_t kept = reserved_bytes();
  CHECK(kept > 0);
  for (int i = 0; i < 3; ++i) {
    smooth_on_device(mesh);
    CHECK(reserved_bytes() < 2 * kept);
  }
  REQUIRE(cudaDeviceSynchronize() == cudaSuccess);
  cuda::give_memory_back();
  CHECK(reserved_bytes() < kept);
}

TEST_CASE("arrays of the host are counted beside what a plan on the device takes") {
  const Mesh mesh = test_meshes::jittered_grid(60, 50, 0.3, 1);
  cuda::Context context;
  const cuda::DeviceBuffer<std::int32_t> triangles(context, mesh.indices());
  cuda::DeviceBuffer<double> xy(context, mesh.xy());
  const auto triangle_count = static_cast<std::int32_t>(mesh.triangles.size());
  const std::int64_t of_plan =
      cuda::smooth({mesh.vertex_count(), triangle_count, triangles.data(), {}}, xy.data(), {}, context.stream())
          .device_memory_bytes;
  CHECK(smooth_on_device(mesh).device_memory_bytes == of_plan + static_cast<std::int64_t>(context.bytes_in_use()));
}

TEST_CASE("arrays of every length arrive, from pageable and from page-locked memory") {
  cuda::Context context;
  for (const int threads : {1, 0}) {
    cuda::HostCopier copier(context, threads);
    // Pieces are 2 MiB, three are on their way at a time, and small arrays are not cut.
    constexpr std::size_t piece = (std::size_t{1} << 21U) / sizeof(std::int32_t);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, piece / 2, piece - 1, piece,
                                    piece + 1, 2 * piece, 3 * piece, 3 * piece + 1, 11 * piece + 12345}) {
      CAPTURE(threads, count);
      std::vector<std::int32_t> values = numbers(count);
      require_round_trip(copier, context, values);
      if (count > 0) {
        REQUIRE(cudaHostRegister(values.data(), count * sizeof(std::int32_t), cudaHostRegisterDefault) == cudaSuccess);
        require_round_trip(copier, context, values);
        REQUIRE(cudaHostUnregister(values.data()) == cudaSuccess);
      }
    }
  }
}

TEST_CASE("copies of several threads at a time do not meet") {
  std::vector<std::vector<std::int32_t>> found(4);
  const std::vector<std::int32_t> values = numbers(std::size_t{3} << 20U);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back([&, i] {
      cuda::Context context;
      cuda::HostCopier copier(context, 2);
      std::vector<std::int32_t> own = values;
      own.front() = static_cast<std::int32_t>(i);
      for (int round = 0; round < 5; ++round) {
        const cuda::DeviceBuffer<std::int32_t> device = copier.uploaded(std::span<const std::int32_t>(own));
        found[i].assign(own.size(), 0);
        copier.download(std::span(found[i]), device);
        if (found[i] != own) {
          return;
        }
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(found[i].front() == static_cast<std::int32_t>(i));
    CHECK(std::equal(found[i].begin() + 1, found[i].end(), values.begin() + 1));
  }
}
