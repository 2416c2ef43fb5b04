// SPDX-License-Identifier: BSD-3-Clause
// Plans for two devices leave no thread and no socket behind: NCCL's stay to the end of the process, so it is asked for
// them once and not for every plan.
//
// Exit status 77: there are no two devices, or no NCCL, skipped.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/parts/nccl.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/smooth.h"

#include "support/test_meshes.h"

namespace {

constexpr int skipped = 77;

/// What the process has.
struct Held {
  std::ptrdiff_t threads = 0;
  std::ptrdiff_t sockets = 0;

  bool operator==(const Held&) const = default;
};

Held held_now() {
  using Entries = std::filesystem::directory_iterator;
  // The system lists a thread for a moment longer than it takes to join it.
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto is_socket = [](const std::filesystem::directory_entry& file) {
    std::error_code is_gone;
    return std::filesystem::read_symlink(file.path(), is_gone).native().starts_with("socket:");
  };
  return {std::distance(Entries("/proc/self/task"), Entries()),
          std::count_if(Entries("/proc/self/fd"), Entries(), is_socket)};
}

/// Makes a plan, uses it and lets it go: whether vertices moved.
bool use_plan(const test_meshes::Mesh& mesh, const trismooth::SmoothingOptions& options) {
  trismooth::SmoothingPlan plan(mesh.vertex_count(), mesh.indices(), options);
  std::vector<double> xy = mesh.xy();
  return plan.smooth(xy).moved_vertices > 0;
}

int run() {
  if (trismooth::cuda::survey_devices().devices.size() < 2) {
    std::printf("skipped: this machine has fewer than two CUDA devices\n");
    return skipped;
  }
  if (trismooth::cuda::nccl::library() == nullptr) {
    std::printf("skipped: there is no libnccl.so.2\n");
    return skipped;
  }
  const std::array devices{0, 1};
  const std::unique_ptr<trismooth::Backend> backend = trismooth::cuda::backend_on(devices);
  trismooth::SmoothingOptions options;
  options.backend = backend.get();
  options.threads = 1;  // those of the CPU are started as they are needed
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 1);
  bool all_moved = use_plan(mesh, options);
  const Held after_one = held_now();
  constexpr int more = 100;
  for (int i = 0; i < more; ++i) {
    all_moved = use_plan(mesh, options) && all_moved;
  }
  const Held after_all = held_now();
  std::printf("after the first plan: %td threads, %td sockets; after %d more: %td threads, %td sockets\n",
              after_one.threads, after_one.sockets, more, after_all.threads, after_all.sockets);
  if (!all_moved) {
    std::printf("a plan moved nothing\n");
  }
  return all_moved && after_one == after_all ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "test_cuda_many_plans: error: %s\n", error.what());
    return 1;
  }
}
