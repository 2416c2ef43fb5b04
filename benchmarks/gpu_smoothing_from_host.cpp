// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include <cuda_runtime_api.h>
#include <fmt/format.h>

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/smoothing/smooth.h"

#include "gpu_smoothing_experiments.h"

namespace benchmarks {

using namespace trismooth;

namespace {

/// Memory of the caller that is page-locked for as long as this lives.
class PageLocked {
 public:
  template <class T>
  explicit PageLocked(std::span<T> values) : memory_(values.data()) {
    TRISMOOTH_CUDA_CHECK(cudaHostRegister(memory_, values.size_bytes(), cudaHostRegisterDefault));
  }
  PageLocked(const PageLocked&) = delete;
  PageLocked& operator=(const PageLocked&) = delete;
  ~PageLocked() { cudaHostUnregister(memory_); }

 private:
  void* memory_;
};

void measure_arrays(Session& session, const RandomMesh& mesh, bool locked, const std::string& form,
                    const std::string& precision) {
  SmoothingOptions options = session.options("resident", "-", form, precision, mesh);
  options.topology = Topology::device;
  const auto indices = flat_triangles(mesh);
  std::vector<std::int32_t> triangles(indices.begin(), indices.end());
  std::vector<double> xy(flat_points(mesh).size());
  std::optional<PageLocked> locked_triangles;
  std::optional<PageLocked> locked_xy;
  if (locked) {
    locked_triangles.emplace(std::span(triangles));
    locked_xy.emplace(std::span(xy));
  }
  SameBits bits(session);
  SmoothingResult result;
  std::vector<double> calls;
  std::vector<std::vector<double>> parts(5);
  double first = 0;
  for (int run = -1; run < session.settings().runs; ++run) {
    std::ranges::copy(flat_points(mesh), xy.begin());
    const double call = milliseconds_of([&] { result = smooth(xy_points(xy), triangles, {}, options); });
    bits.compare(xy);
    if (run < 0) {  // it warms up
      first = call;
      continue;
    }
    calls.push_back(call);
    const SmoothingTimings& timings = result.timings;
    const std::array known{timings.transfer_in, timings.prepare, timings.smooth, timings.commit, timings.transfer_out};
    for (std::size_t part = 0; part < parts.size(); ++part) {
      parts[part].push_back(known[part]);
    }
  }
  const char* const memory = locked ? "pinned" : "pageable";
  fmt::print(" {:>9} {:<8} {:<4} {:<6} {:>24}", vertex_count_of(mesh), memory, form, precision, Spread(calls).text());
  double rest = Spread(calls).median;
  for (const std::vector<double>& part : parts) {
    rest -= Spread(part).median;
    fmt::print(" {:>9.3f}", Spread(part).median);
  }
  fmt::print(" {:>9.3f} {:>9.3f}\n", rest, first);
  std::fflush(stdout);
  session.report()["host_arrays"].push_back({{"vertices", vertex_count_of(mesh)},
                                             {"memory", memory},
                                             {"form", form},
                                             {"precision", precision},
                                             {"method", session.settings().method},
                                             {"topology", "device"},
                                             {"runs", session.settings().runs},
                                             {"sweeps", result.sweeps},
                                             {"call_ms", json_of(Spread(calls))},
                                             {"coordinates_in_ms", json_of(Spread(parts[0]))},
                                             {"prepare_ms", json_of(Spread(parts[1]))},
                                             {"sweeps_ms", json_of(Spread(parts[2]))},
                                             {"commit_ms", json_of(Spread(parts[3]))},
                                             {"coordinates_out_ms", json_of(Spread(parts[4]))},
                                             {"first_call_ms", first},
                                             {"coordinates_hash", bits.hash()}});
}

/// Sweeps and commit of one way to smooth.
Spread to_stop(const RandomMesh& mesh, const SmoothingOptions& options, int runs, SameBits& bits) {
  SmoothingPlan prepared = plan(vertex_count_of(mesh), flat_triangles(mesh), {}, options);
  std::vector<double> total;
  for (int run = 0; run < runs; ++run) {
    std::vector<double> xy(flat_points(mesh).begin(), flat_points(mesh).end());
    const SmoothingResult result = prepared.smooth(xy);
    total.push_back(result.timings.smooth + result.timings.commit);
    bits.compare(xy);
  }
  return Spread(total);
}

void measure_serial(Session& session, const RandomMesh& mesh, const std::string& form, const std::string& precision) {
  constexpr int most_serial_runs = 3;
  const int runs = session.settings().runs;
  SameBits bits(session);
  const Spread device = to_stop(mesh, session.options("resident", "-", form, precision, mesh), runs, bits);
  SmoothingOptions options = session.options("cpu", "-", form, precision, mesh);
  const Spread best = to_stop(mesh, options, runs, bits);
  options.threads = 1;
  options.evaluation = Evaluation::all;
  const Spread serial = to_stop(mesh, options, std::min(runs, most_serial_runs), bits);
  fmt::print(" {:>9} {:<4} {:<6} {:>24} {:>24} {:>24} {:>8.1f} {:>8.1f}  {}\n", vertex_count_of(mesh), form, precision,
             device.text(), serial.text(), best.text(), serial.median / device.median, best.median / device.median,
             bits.hash());
  std::fflush(stdout);
  session.report()["serial"].push_back({{"vertices", vertex_count_of(mesh)},
                                        {"form", form},
                                        {"precision", precision},
                                        {"method", session.settings().method},
                                        {"runs", runs},
                                        {"resident_ms", json_of(device)},
                                        {"cpu_one_thread_all_vertices_ms", json_of(serial)},
                                        {"cpu_all_threads_changed_ms", json_of(best)},
                                        {"times_the_serial", serial.median / device.median},
                                        {"times_all_threads", best.median / device.median},
                                        {"coordinates_hash", bits.hash()}});
}

}  // namespace

void smooth_host_arrays(Session& session) {
  session.require_device();
  fmt::print(
      "\nhost arrays in, smoothed host arrays out, topology by the device: milliseconds by the host's clock,\n"
      "median (least-most) after one call that warms up; the parts that the result names, and the rest (triangles in,\n"
      "topology, memory)\n"
      " {:>9} {:<8} {:<4} {:<6} {:>24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
      "vertices", "memory", "form", "prec.", "a call", "in", "prepare", "sweeps", "commit", "out", "rest", "first");
  for (const std::int64_t vertices : session.sizes({1'000'000})) {
    for (const std::string& precision : session.settings().precisions) {
      for (const std::string& form : session.settings().forms) {
        for (const bool locked : {false, true}) {
          measure_arrays(session, session.mesh(vertices), locked, form, precision);
        }
      }
    }
  }
}

void compare_with_serial(Session& session) {
  session.require_device();
  fmt::print(
      "\nbeside the CPU, to the stop: milliseconds of sweeps and commit, median (least-most), and times as fast\n"
      "\"serial\": one thread, every vertex in every sweep; \"CPU\": all threads, changed neighbourhoods\n"
      " {:>9} {:<4} {:<6} {:>24} {:>24} {:>24} {:>8} {:>8}  {}\n",
      "vertices", "form", "prec.", "resident", "serial", "CPU", "serial/", "CPU/", "hash");
  for (const std::int64_t vertices : session.sizes({100'000, 1'000'000})) {
    for (const std::string& precision : session.settings().precisions) {
      for (const std::string& form : session.settings().forms) {
        measure_serial(session, session.mesh(vertices), form, precision);
      }
    }
  }
}

}  // namespace benchmarks
