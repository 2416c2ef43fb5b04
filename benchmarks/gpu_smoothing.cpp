// Measures smoothing on a CUDA device beside the CPU, on random Delaunay meshes (the paper's test data; mirrored tiles
// above 4M vertices), and checks on the way that every run gives the same bits.
//
//     gpu_smoothing --vertices 100000 1000000 --precision single --executions resident --runs 7 --json results.json
//
// Times are those of the device's own clock. A mesh is analysed and packed once ("prepare"); then its coordinates are
// smoothed --runs times. "sweeps" and "commit" are what smoothing takes on the device; the copies of the coordinates
// there and back are given apart. The bandwidth of a copy in device memory, measured in the same run, stands beside
// them: a sweep over all vertices (--evaluation all) moves 44 bytes a vertex in single precision and 60 in double at
// least.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <cuda_runtime_api.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/error.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/random_mesh.h"
#include "trismooth/smoothing/smooth.h"

namespace {

using namespace trismooth;
using Json = nlohmann::ordered_json;

struct Settings {
  std::vector<std::int64_t> vertices{1'000, 10'000, 100'000, 1'000'000};
  std::vector<std::string> executions{"cpu", "single-block", "cdp", "resident"};
  std::vector<std::string> layouts{"aos", "soa"};
  std::vector<std::string> forms{"a", "b"};
  std::vector<std::string> precisions{"single", "double"};
  std::string method = "smart";
  std::string topology = "halfedge";
  std::string evaluation = "changed";
  std::int64_t max_sweeps = 1000;
  int runs = 7;
  int threads = 0;
  std::string json;
};

Json spread(std::vector<double> values) {
  std::ranges::sort(values);
  return {{"median", values[values.size() / 2]}, {"min", values.front()}, {"max", values.back()}};
}

/// Bytes read and written a second by a copy within device memory, the median of several.
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
  std::ranges::sort(seconds);
  return 2 * static_cast<double>(bytes) / seconds[runs / 2];
}

/// The most device memory that was in use since the last call, as CUDA's own allocator counts it.
std::uint64_t most_memory_used() {
  cudaMemPool_t pool = nullptr;
  TRISMOOTH_CUDA_CHECK(cudaDeviceGetDefaultMemPool(&pool, 0));
  std::uint64_t used = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolGetAttribute(pool, cudaMemPoolAttrUsedMemHigh, &used));
  std::uint64_t zero = 0;
  TRISMOOTH_CUDA_CHECK(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrUsedMemHigh, &zero));
  return used;
}

std::uint64_t hash_of(std::span<const double> xy) {
  std::vector<double> xyz;
  xyz.reserve(xy.size() / 2 * 3);
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    xyz.insert(xyz.end(), {xy[i], xy[i + 1], 0.0});
  }
  return coordinates_hash(xyz);
}

class Benchmark {
 public:
  explicit Benchmark(const Settings& settings) : settings_(settings) {
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

  bool run() {
    for (const std::int64_t vertices : settings_.vertices) {
      const RandomMesh mesh = random_delaunay_mesh(vertices, 1);
      fmt::print("\n{} vertices, {} triangles\n", mesh.points.size(), mesh.triangles.size());
      fmt::print(" {:<12} {:<4} {:<4} {:<6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6} {:>7} {:>8} {:>6}  {}\n",
                 "execution", "lay.", "form", "prec.", "prepare", "in", "sweeps", "commit", "out", "ms, total",
                 "sweeps", "updates", "ps/upd.", "B/vtx", "hash");
      for (const std::string& precision : settings_.precisions) {
        for (const std::string& form : settings_.forms) {
          expected_.reset();
          for (const std::string& execution : settings_.executions) {
            const bool on_cpu = execution == "cpu";
            for (const std::string& layout : on_cpu ? std::vector<std::string>{"-"} : settings_.layouts) {
              if (on_cpu || has_device_) {
                measure(mesh, execution, layout, form, precision);
              }
            }
          }
        }
      }
    }
    if (!settings_.json.empty()) {
      std::ofstream(settings_.json) << report_.dump(1) << '\n';
    }
    fmt::print("\nbits: {}\n", same_bits_ ? "every run of a form and precision gave the same" : "DIFFERENT");
    return same_bits_;
  }

 private:
  SmoothingOptions options(const std::string& execution, const std::string& layout, const std::string& form,
                           const std::string& precision) const {
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
      options.layout = parse_enum<Layout>(layout);
      options.topology = parse_enum<Topology>(settings_.topology);
    }
    return options;
  }

  void measure(const RandomMesh& mesh, const std::string& execution, const std::string& layout, const std::string& form,
               const std::string& precision) {
    const auto count = static_cast<std::int32_t>(mesh.points.size());
    const std::span<const std::int32_t> triangles(mesh.triangles.front().data(), 3 * mesh.triangles.size());
    const std::span<const double> points(&mesh.points.front().x, 2 * mesh.points.size());
    if (has_device_) {
      most_memory_used();
    }
    SmoothingPlan prepared = plan(count, triangles, {}, options(execution, layout, form, precision));
    std::vector<double> in;
    std::vector<double> sweeps;
    std::vector<double> commit;
    std::vector<double> out;
    std::vector<double> total;
    SmoothingResult result;
    double prepare = 0;
    for (int run = 0; run < settings_.runs; ++run) {
      std::vector<double> xy(points.begin(), points.end());
      result = prepared.smooth(xy);
      prepare = run == 0 ? result.timings.prepare : prepare;
      in.push_back(result.timings.transfer_in);
      sweeps.push_back(result.timings.smooth);
      commit.push_back(result.timings.commit);
      out.push_back(result.timings.transfer_out);
      total.push_back(result.timings.smooth + result.timings.commit);
      const std::uint64_t hash = hash_of(xy);
      same_bits_ = same_bits_ && hash == expected_.value_or(hash);
      expected_ = hash;
    }
    const double per_vertex = static_cast<double>(has_device_ ? most_memory_used() : 0) / count;
    const Json all = spread(total);
    const double update_ps = spread(sweeps)["median"].get<double>() * 1e9 /
                             static_cast<double>(std::max<std::int64_t>(1, result.vertex_updates));
    const auto median = [](const std::vector<double>& values) { return spread(values)["median"].get<double>(); };
    fmt::print(
        " {:<12} {:<4} {:<4} {:<6} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>6} {:>7.2f} {:>8.1f} "
        "{:>6.1f}  {}\n",
        execution, layout, form, precision, prepare, median(in), median(sweeps), median(commit), median(out),
        median(total), result.sweeps,
        static_cast<double>(result.vertex_updates) / static_cast<double>(result.free_vertices), update_ps, per_vertex,
        hash_text(*expected_));
    std::fflush(stdout);
    report_["rows"].push_back({{"vertices", count},
                               {"execution", execution},
                               {"layout", layout},
                               {"form", form},
                               {"precision", precision},
                               {"method", settings_.method},
                               {"topology", execution == "cpu" ? "halfedge" : settings_.topology},
                               {"evaluation", settings_.evaluation},
                               {"threads", result.threads},
                               {"device", result.device},
                               {"runs", settings_.runs},
                               {"sweeps", result.sweeps},
                               {"stop_reason", std::string(to_string(result.stop_reason))},
                               {"vertex_updates", result.vertex_updates},
                               {"free_vertices", result.free_vertices},
                               {"kernel_launches", result.kernel_launches},
                               {"child_launches", result.child_launches},
                               {"prepare_ms", prepare},
                               {"transfer_in_ms", spread(in)},
                               {"sweeps_ms", spread(sweeps)},
                               {"commit_ms", spread(commit)},
                               {"transfer_out_ms", spread(out)},
                               {"sweeps_and_commit_ms", all},
                               {"device_bytes_per_vertex", per_vertex},
                               {"coordinates_hash", hash_text(*expected_)}});
    if (settings_.evaluation == "all" && execution != "cpu") {
      print_share_of_bandwidth(result, precision, median(sweeps));
    }
  }

  /// How near full sweeps come to what device memory allows.
  void print_share_of_bandwidth(const SmoothingResult& result, const std::string& precision,
                                double milliseconds) const {
    const double bytes = precision == "single" ? 44 : 60;
    const double rate = bytes * static_cast<double>(result.vertex_updates) / (milliseconds / 1000);
    fmt::print(" {:<12} {:.0f} bytes an update: {:.2f} of the copy bandwidth\n", "", bytes, rate / bandwidth_);
  }

  const Settings& settings_;
  Json report_;
  double bandwidth_ = 0;
  bool has_device_ = false;
  std::optional<std::uint64_t> expected_;
  bool same_bits_ = true;
};

int run(int argc, char** argv) {
  CLI::App app("Measures smoothing on a CUDA device beside the CPU");
  Settings settings;
  app.add_option("--vertices", settings.vertices)->capture_default_str();
  app.add_option("--executions", settings.executions, "cpu, single-block, cdp, resident")->capture_default_str();
  app.add_option("--layouts", settings.layouts)->capture_default_str();
  app.add_option("--forms", settings.forms)->capture_default_str();
  app.add_option("--precisions", settings.precisions)->capture_default_str();
  app.add_option("--method", settings.method)->capture_default_str();
  app.add_option("--topology", settings.topology, "halfedge, or device")->capture_default_str();
  app.add_option("--evaluation", settings.evaluation, "changed, or all: every vertex in every sweep")
      ->check(CLI::IsMember({"changed", "all"}))
      ->capture_default_str();
  app.add_option("--max-sweeps", settings.max_sweeps)->capture_default_str();
  app.add_option("--runs", settings.runs)->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--threads", settings.threads, "of the CPU rows; 0: one for each core")->capture_default_str();
  app.add_option("--json", settings.json, "write all figures to this file");
  CLI11_PARSE(app, argc, argv);
  return Benchmark(settings).run() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gpu_smoothing: error: %s\n", error.what());
    return 1;
  }
}
