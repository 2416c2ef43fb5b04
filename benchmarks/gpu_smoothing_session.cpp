// SPDX-License-Identifier: BSD-3-Clause
#include "gpu_smoothing_session.h"

#include <algorithm>
#include <cstring>

#include <cuda_runtime_api.h>
#include <fmt/format.h>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/memory_pool.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/pipeline/coordinates_hash.h"

namespace benchmarks {

using namespace trismooth;

namespace {

/// From this many vertices on the device finds the topology, unless the command line says otherwise: the host would
/// take longer than everything that is measured.
constexpr std::int64_t vertices_for_device_topology = 4'000'000;

double copy_bandwidth() {
  constexpr std::size_t bytes = std::size_t{1} << 30U;
  constexpr int runs = 9;
  void* from = nullptr;
  void* to = nullptr;
  TRISMOOTH_CUDA_CHECK(cudaMalloc(&from, bytes));
  TRISMOOTH_CUDA_CHECK(cudaMalloc(&to, bytes));
  TRISMOOTH_CUDA_CHECK(cudaMemset(from, 1, bytes));
  cudaEvent_t start = nullptr;
  cudaEvent_t stop = nullptr;
  TRISMOOTH_CUDA_CHECK(cudaEventCreate(&start));
  TRISMOOTH_CUDA_CHECK(cudaEventCreate(&stop));
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    TRISMOOTH_CUDA_CHECK(cudaEventRecord(start));
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice));
    TRISMOOTH_CUDA_CHECK(cudaEventRecord(stop));
    TRISMOOTH_CUDA_CHECK(cudaEventSynchronize(stop));
    float elapsed = 0;
    TRISMOOTH_CUDA_CHECK(cudaEventElapsedTime(&elapsed, start, stop));
    seconds.push_back(static_cast<double>(elapsed) / 1000);
  }
  TRISMOOTH_CUDA_CHECK(cudaEventDestroy(start));
  TRISMOOTH_CUDA_CHECK(cudaEventDestroy(stop));
  TRISMOOTH_CUDA_CHECK(cudaFree(from));
  TRISMOOTH_CUDA_CHECK(cudaFree(to));
  return 2 * static_cast<double>(bytes) / Spread(seconds).median;
}

}  // namespace

Json json_of(const Spread& spread) {
  return {{"median", spread.median}, {"least", spread.least}, {"most", spread.most}};
}

Session::Session(const Settings& settings) : settings_(settings) {
  const cuda::DeviceSurvey survey = cuda::survey_devices();
  has_device_ = !survey.devices.empty();
  report_["device"] = has_device_ ? survey.devices.front().name : survey.problem;
  if (has_device_) {
    bandwidth_ = copy_bandwidth();
    report_["copy_bandwidth_bytes_per_second"] = bandwidth_;
  }
  fmt::print("device: {}; a copy in device memory: {:.2f} TB/s\n", report_["device"].get<std::string>(),
             bandwidth_ / 1e12);
}

void Session::require_device() const {
  cuda::require_device();
}

std::vector<std::int64_t> Session::sizes(std::initializer_list<std::int64_t> of_experiment) const {
  return settings_.vertices.empty() ? std::vector(of_experiment) : settings_.vertices;
}

const RandomMesh& Session::mesh(std::int64_t vertices) {
  const auto found = meshes_.find(vertices);
  return found != meshes_.end()
             ? found->second
             : meshes_
                   .emplace(vertices,
                            random_delaunay_mesh(vertices, 1, {parse_enum<GeneratedBoundary>(settings_.boundary)}))
                   .first->second;
}

SmoothingOptions Session::options(const std::string& execution, const std::string& layout, const std::string& form,
                                  const std::string& precision, const RandomMesh& mesh) const {
  SmoothingOptions options;
  options.method = parse_enum<Method>(settings_.method);
  options.form = parse_enum<Form>(form);
  options.precision = parse_enum<Precision>(precision);
  options.evaluation = settings_.evaluation == "all" ? Evaluation::all : Evaluation::changed;
  options.max_sweeps = settings_.max_sweeps;
  options.threads = settings_.threads;
  if (execution != "cpu") {
    options.backend = &cuda::backend();
    options.execution = parse_enum<Execution>(execution);
    options.layout = layout == "-" ? Layout::aos : parse_enum<Layout>(layout);
    if (settings_.topology != "auto") {
      options.topology = parse_enum<Topology>(settings_.topology);
    } else {
      options.topology = vertex_count_of(mesh) >= vertices_for_device_topology ? Topology::device : Topology::host;
    }
  }
  return options;
}

void SameBits::compare(std::span<const double> xy) {
  if (first_.empty()) {
    first_.assign(xy.begin(), xy.end());
  } else if (xy.size() != first_.size() || std::memcmp(xy.data(), first_.data(), xy.size_bytes()) != 0) {
    session_.note_different_bits();
    fmt::print("   DIFFERENT BITS\n");
  }
}

std::string SameBits::hash() const {
  return hash_text(planar_coordinates_hash(first_));
}

std::int32_t vertex_count_of(const RandomMesh& mesh) {
  return static_cast<std::int32_t>(mesh.points.size());
}

double milliseconds_of(const std::function<void()>& function) {
  const Stopwatch watch;
  function();
  return watch.milliseconds();
}

std::uint64_t most_memory_used() {
  cudaMemPool_t pool = cuda::memory_pool();
  std::uint64_t used = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolGetAttribute(pool, cudaMemPoolAttrUsedMemHigh, &used));
  std::uint64_t zero = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrUsedMemHigh, &zero));
  return used;
}

}  // namespace benchmarks
