// SPDX-License-Identifier: BSD-3-Clause
// Where the backend's memory comes from, what it counts, and how the caller's arrays get there and back.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/cuda/runtime/host_copy.h"
#include "trismooth/smoothing/errors.h"
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
  return smooth(xy_points(xy), mesh.indices(), {}, options);
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
  ScratchBytes kept;
  for (const bool meanwhile : {false, true}) {
    std::ranges::fill(back, 0);
    Overwriting target(std::as_writable_bytes(std::span(back)), &kept, copier.workers());
    if (meanwhile) {
      target.keep_meanwhile();
    }
    copier.download(target, device);
    REQUIRE(back == values);
  }
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

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

std::size_t free_bytes() {
  std::size_t free = 0;
  std::size_t total = 0;
  REQUIRE(cudaMemGetInfo(&free, &total) == cudaSuccess);
  return free;
}

/// What the pool has handed out, and nobody has given back.
std::uint64_t used_bytes() {
  REQUIRE(cudaDeviceSynchronize() == cudaSuccess);
  std::uint64_t bytes = 0;
  REQUIRE(cudaMemPoolGetAttribute(cuda::memory_pool(), cudaMemPoolAttrUsedMemCurrent, &bytes) == cudaSuccess);
  return bytes;
}

/// Takes all memory of the device but a little, and gives it back in the end.
class Ballast {
 public:
  explicit Ballast(std::size_t left) {
    REQUIRE(cudaDeviceSynchronize() == cudaSuccess);
    cuda::give_memory_back();
    for (std::size_t chunk = std::size_t{1} << 38U; chunk >= 2 * mebibyte; chunk /= 2) {
      void* memory = nullptr;
      while (free_bytes() >= left + chunk && cudaMalloc(&memory, chunk) == cudaSuccess) {
        chunks_.push_back(memory);
      }
      cudaGetLastError();
    }
  }
  Ballast(const Ballast&) = delete;
  Ballast& operator=(const Ballast&) = delete;
  ~Ballast() {
    for (void* const memory : chunks_) {
      cudaFree(memory);
    }
  }

 private:
  std::vector<void*> chunks_;
};

/// Coordinates on the device that nobody but the test owns.
template <class T>
class DeviceArray {
 public:
  explicit DeviceArray(const std::vector<T>& values) : size_(values.size()) {
    REQUIRE(cudaMalloc(&data_, size_ * sizeof(T)) == cudaSuccess);
    REQUIRE(cudaMemcpy(data_, values.data(), size_ * sizeof(T), cudaMemcpyHostToDevice) == cudaSuccess);
  }
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { cudaFree(data_); }

  T* data() { return static_cast<T*>(data_); }
  std::vector<double> values() const {
    std::vector<T> values(size_);
    REQUIRE(cudaMemcpy(values.data(), data_, size_ * sizeof(T), cudaMemcpyDeviceToHost) == cudaSuccess);
    return {values.begin(), values.end()};
  }

 private:
  void* data_ = nullptr;
  std::size_t size_;
};

/// A way to the device: smooths `before` and leaves in `after` what the caller's coordinates are then, also where it
/// throws. What the caller owns on the device is there before `all_but_little` takes the memory.
struct Way {
  std::string name;
  std::function<void(const Mesh& mesh, const SmoothingOptions& options, const std::function<void()>& all_but_little,
                     std::vector<double>& after)>
      smooth;
};

std::vector<Way> ways_to_the_device() {
  const auto from_host = [](Topology topology) {
    return [topology](const Mesh& mesh, SmoothingOptions options, const std::function<void()>& all_but_little,
                      std::vector<double>& after) {
      options.topology = topology;
      options.backend = &cuda::backend();
      after = mesh.xy();
      all_but_little();
      smooth(xy_points(after), mesh.indices(), {}, options);
    };
  };
  const auto from_device = [](auto zero, bool planned) {
    using T = decltype(zero);
    return [planned](const Mesh& mesh, const SmoothingOptions& options, const std::function<void()>& all_but_little,
                     std::vector<double>& after) {
      const std::vector<double> xy = mesh.xy();
      const auto indices = mesh.indices();
      DeviceArray<std::int32_t> triangles(std::vector<std::int32_t>(indices.begin(), indices.end()));
      DeviceArray<T> coordinates(std::vector<T>(xy.begin(), xy.end()));
      const cuda::DeviceMesh view{
          mesh.vertex_count(), static_cast<std::int32_t>(mesh.triangles.size()), triangles.data(), {}};
      try {
        if (planned) {
          // What it takes to analyse the mesh is there, what it takes to smooth it is not.
          cuda::Plan plan(view, options);
          all_but_little();
          plan.smooth(coordinates.data());
        } else {
          all_but_little();
          cuda::smooth(view, coordinates.data(), options);
        }
      } catch (const DeviceError&) {
        after = coordinates.values();
        throw;
      }
      after = coordinates.values();
    };
  };
  return {{"host arrays, topology of the host", from_host(Topology::host)},
          {"host arrays, topology of the device", from_host(Topology::device)},
          {"device arrays", from_device(0.0, false)},
          {"device arrays of floats", from_device(0.0F, false)},
          {"a plan", from_device(0.0, true)},
          {"a plan, of floats", from_device(0.0F, true)}};
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Smooths with so much memory left. True where that sufficed; else all must be as it was, and the message clear.
bool smooth_with_little(const Way& way, const Mesh& mesh, const SmoothingOptions& options, std::size_t left,
                        const std::vector<double>& input, const std::vector<double>& expected) {
  REQUIRE(cudaDeviceSynchronize() == cudaSuccess);
  cuda::give_memory_back();
  const std::uint64_t used = used_bytes();
  std::vector<double> after;
  std::unique_ptr<Ballast> ballast;
  const auto all_but_little = [&] { ballast = std::make_unique<Ballast>(left); };
  bool sufficed = false;
  std::string message;
  try {
    way.smooth(mesh, options, all_but_little, after);
    sufficed = true;
  } catch (const DeviceError& error) {
    message = error.what();
  }
  CAPTURE(message);
  REQUIRE(cudaGetLastError() == cudaSuccess);
  REQUIRE(used_bytes() == used);
  REQUIRE(same_bits(after, sufficed ? expected : input));
  if (!sufficed) {
    REQUIRE(message.find("CUDA: cudaErrorMemoryAllocation") == 0);
    REQUIRE(message.find("needs ") != std::string::npos);
    REQUIRE(message.find(" MiB") != std::string::npos);
    REQUIRE(message.find("--backend cpu") != std::string::npos);
  }
  return sufficed;
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

TEST_CASE("however little memory is left: an error that says how much is needed, nothing leaked, nothing touched") {
  const Mesh mesh = test_meshes::jittered_grid(500, 400, 0.3, 1);
  const std::vector<double> xy = mesh.xy();
  smooth_on_device(mesh);
  constexpr std::size_t enough = 2048 * mebibyte;
  const Ballast most(enough);  // to take all of it anew each time would take long
  for (const Execution execution : {Execution::resident, Execution::single_block, Execution::cdp}) {
    if (execution == Execution::cdp && !cuda::has_cdp()) {
      continue;
    }
    for (const Form form : {Form::swap, Form::in_place}) {
      SmoothingOptions options;
      options.execution = execution;
      options.form = form;
      options.max_sweeps = 3;
      for (const Way& way : ways_to_the_device()) {
        CAPTURE(to_string(execution), to_string(form), way.name);
        // With all the memory that there is; what CUDA itself keeps for these kernels is there from then on.
        std::vector<double> expected;
        way.smooth(
            mesh, options, [] {}, expected);
        const bool floats = way.name.find("floats") != std::string::npos;
        const std::vector<float> rounded(xy.begin(), xy.end());
        const std::vector<double> input = floats ? std::vector<double>(rounded.begin(), rounded.end()) : xy;
        cuda::give_memory_back();
        const std::size_t free_before = free_bytes();
        // More by and by, until it suffices.
        std::size_t left = 0;
        int refused = 0;
        while (left < enough && !smooth_with_little(way, mesh, options, left, input, expected)) {
          left += 4 * mebibyte;
          ++refused;
        }
        CAPTURE(left, refused);
        CHECK(left < enough);
        // A plan may hold all that it needs from when it was made on.
        const bool plan = way.name.starts_with("a plan");
        CHECK((refused > 0 || plan));
        // Memory is back: so is the result.
        std::vector<double> again;
        way.smooth(
            mesh, options, [] {}, again);
        CHECK(same_bits(again, expected));
        REQUIRE(cudaDeviceSynchronize() == cudaSuccess);
        cuda::give_memory_back();
        CHECK(free_bytes() + 8 * mebibyte >= free_before);
      }
    }
  }
}
