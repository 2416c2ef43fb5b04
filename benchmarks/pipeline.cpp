// SPDX-License-Identifier: BSD-3-Clause
// Measures whole runs from file to file, stage by stage, by size, format and number of threads, beside VTK's reader,
// writer and smoothing filter in the same process.
//
//     pipeline --vertices 100000 1000000 --formats off vtk vtu --threads 1 2 --runs 3 --json pipeline.json

#include "trismooth/pipeline/pipeline.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trismooth/base/machine/processor_name.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/pipeline/generate/random_document.h"
#include "trismooth/pipeline/report/spread.h"

#include "mesh_files.h"
#include "run_reporting.h"
#include "vtk_runs.h"

namespace {

using namespace trismooth;

struct Settings {
  std::vector<std::int64_t> vertices{10'000, 100'000, 1'000'000};
  std::vector<std::string> formats{"off", "vtk", "vtu"};
  std::vector<int> threads{1, 2};
  int runs = 3;
  bool vtk = true;
  std::filesystem::path folder = std::filesystem::temp_directory_path();
  std::string json;
};

constexpr int vtk_sweeps = 100;

/// A row of the table: what is measured, on what, and its times in milliseconds by stage.
struct Row {
  std::string tool;
  std::string format;
  std::int64_t vertices = 0;
  int threads = 1;
  std::vector<std::pair<std::string, double>> stages;
  std::int64_t peak_memory_bytes = 0;

  double of(const std::string& stage) const {
    const auto found = std::ranges::find(stages, stage, &std::pair<std::string, double>::first);
    return found == stages.end() ? 0 : found->second;
  }
};

std::vector<std::pair<std::string, double>> stages_of(const PipelineTimings& t) {
  const double named = t.read + t.topology + t.check_before + t.smooth + t.guard + t.check_after + t.write;
  return {{"read", t.read},     {"topology", t.topology},     {"check", t.check_before},
          {"smooth", t.smooth}, {"guard", t.guard},           {"check after", t.check_after},
          {"write", t.write},   {"between", t.total - named}, {"total", t.total}};
}

/// The medians of several runs, stage by stage.
std::vector<std::pair<std::string, double>> medians(
    int runs, const std::function<std::vector<std::pair<std::string, double>>()>& measure) {
  std::vector<std::vector<double>> values;
  std::vector<std::pair<std::string, double>> result;
  for (int run = 0; run < runs; ++run) {
    result = measure();
    values.resize(result.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      values[i].push_back(result[i].second);
    }
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].second = Spread(values[i]).median;
  }
  return result;
}

void print_head() {
  fmt::print("{:<9} {:<10} {:>9} {:>3} {:>8} {:>8} {:>7} {:>8} {:>7} {:>7} {:>8} {:>8} {:>9} {:>7}\n", "tool", "file",
             "vertices", "thr", "read", "topology", "check", "smooth", "guard", "after", "write", "between", "total",
             "ns/vtx");
}

void print(const Row& row) {
  const double total = row.of("total");
  fmt::print("{:<9} {:<10} {:>9} {:>3}", row.tool, row.format, row.vertices, row.threads);
  for (const auto& [stage, width] : {std::pair("read", 8),
                                     {"topology", 8},
                                     {"check", 7},
                                     {"smooth", 8},
                                     {"guard", 7},
                                     {"check after", 7},
                                     {"write", 8},
                                     {"between", 8},
                                     {"total", 9}}) {
    fmt::print(" {:>{}.1f}", row.of(stage), width);
  }
  fmt::print(" {:>7.0f}\n", total * 1e6 / static_cast<double>(row.vertices));
  std::fflush(stdout);
}

class Benchmark {
 public:
  explicit Benchmark(const Settings& settings) : settings_(settings) {}

  void run() {
    fmt::print("{}; milliseconds, medians of {} runs\n\n", processor_name(), settings_.runs);
    print_head();
    for (const std::int64_t vertices : settings_.vertices) {
      const MeshDocument document = document_of(random_delaunay_mesh(vertices, 1));
      for (const std::string& format : settings_.formats) {
        const std::filesystem::path input = mesh_files::path_of(settings_.folder, "pipeline_benchmark_in", format);
        const std::filesystem::path output = mesh_files::path_of(settings_.folder, "pipeline_benchmark_out", format);
        mesh_files::write(input, format, document);
        measure(input, output, format, static_cast<std::int64_t>(document.point_count()));
        std::filesystem::remove(input);
        std::filesystem::remove(output);
      }
    }
    print_threads();
    print_growth();
    print_beside_vtk();
    if (!settings_.json.empty()) {
      write_json();
    }
  }

 private:
  void add(Row row) {
    print(row);
    rows_.push_back(std::move(row));
  }

  void measure(const std::filesystem::path& input, const std::filesystem::path& output, const std::string& format,
               std::int64_t vertices) {
    for (const int threads : settings_.threads) {
      Row row{"trismooth", format, vertices, threads, {}, 0};
      row.stages = medians(settings_.runs, [&] {
        PipelineOptions options;
        options.input = input;
        options.output = output;
        options.smoothing.threads = threads;
        const PipelineResult result = run_pipeline(options);
        row.peak_memory_bytes = result.peak_memory_bytes;
        return stages_of(result.timings_ms);
      });
      add(std::move(row));
    }
    if (settings_.vtk && vtk_runs::reads(format)) {
      Row row{"VTK", format, vertices, 1, {}, 0};
      row.stages = medians(settings_.runs, [&] {
        const vtk_runs::Times times = vtk_runs::run(input, output, format, vtk_sweeps);
        return std::vector<std::pair<std::string, double>>{{"read", times.read},
                                                           {"smooth", times.smooth},
                                                           {"write", times.write},
                                                           {"total", times.read + times.smooth + times.write}};
      });
      add(std::move(row));
    }
  }

  /// Rows of trismooth, each with the one before it that differs in one column alone.
  template <class Same>
  void for_pairs(const Same& same, const std::function<void(const Row&, const Row&)>& visit) const {
    for (auto row = rows_.begin(); row != rows_.end(); ++row) {
      const auto first = std::find_if(rows_.begin(), row, [&](const Row& other) {
        return other.tool == row->tool && other.format == row->format && same(other, *row);
      });
      if (first != row && row->tool == "trismooth") {
        visit(*first, *row);
      }
    }
  }

  void print_threads() const {
    fmt::print("\ntimes as fast by more threads, stages above 50 ms\n");
    for_pairs([](const Row& a, const Row& b) { return a.vertices == b.vertices && a.threads < b.threads; },
              [](const Row& one, const Row& many) {
                fmt::print("{:<10} {:>9} {:>3}", many.format, many.vertices, many.threads);
                for (const auto& [stage, time] : one.stages) {
                  if (time > 50) {
                    fmt::print("  {} {:.2f}", stage, time / many.of(stage));
                  }
                }
                fmt::print("\n");
              });
  }

  void print_growth() const {
    fmt::print("\ntime per vertex beside that of the smallest mesh\n");
    for_pairs([](const Row& a, const Row& b) { return a.threads == b.threads && a.vertices < b.vertices; },
              [](const Row& small, const Row& large) {
                fmt::print("{:<10} {:>9} {:>3}  {:.2f}\n", large.format, large.vertices, large.threads,
                           large.of("total") / static_cast<double>(large.vertices) /
                               (small.of("total") / static_cast<double>(small.vertices)));
              });
  }

  void print_beside_vtk() const {
    fmt::print("\ntimes as fast as VTK, whose smoothing filter makes {} sweeps\n", vtk_sweeps);
    for (const Row& vtk : rows_) {
      for (const Row& row : rows_) {
        if (vtk.tool == "VTK" && row.tool == "trismooth" && row.format == vtk.format && row.vertices == vtk.vertices) {
          fmt::print("{:<10} {:>9} {:>3}  read {:.2f}  smooth and guard {:.1f}  write {:.2f}\n", row.format,
                     row.vertices, row.threads, vtk.of("read") / row.of("read"),
                     vtk.of("smooth") / (row.of("smooth") + row.of("guard")), vtk.of("write") / row.of("write"));
        }
      }
    }
  }

  void write_json() const {
    nlohmann::ordered_json json;
    json["processor"] = processor_name();
    json["runs"] = settings_.runs;
    for (const Row& row : rows_) {
      nlohmann::ordered_json stages;
      for (const auto& [stage, time] : row.stages) {
        stages[stage] = time;
      }
      json["rows"].push_back({{"tool", row.tool},
                              {"format", row.format},
                              {"vertices", row.vertices},
                              {"threads", row.threads},
                              {"milliseconds", stages},
                              {"peak_memory_bytes_of_process", row.peak_memory_bytes}});
    }
    std::ofstream(settings_.json) << json.dump(1) << '\n';
  }

  const Settings& settings_;
  std::vector<Row> rows_;
};

int run(int argc, char** argv) {
  CLI::App app("Measures whole runs from file to file beside VTK");
  Settings settings;
  app.add_option("--vertices", settings.vertices, "mesh sizes")->capture_default_str();
  app.add_option("--formats", settings.formats, "extensions: off, vtk, vtu, ...; msh-binary, msh2, freefem")
      ->capture_default_str();
  app.add_option("--threads", settings.threads, "numbers of threads")->capture_default_str();
  app.add_option("--runs", settings.runs)->capture_default_str()->check(CLI::PositiveNumber);
  app.add_flag("!--no-vtk", settings.vtk, "without VTK beside it");
  app.add_option("--folder", settings.folder, "where meshes are written")->capture_default_str();
  app.add_option("--json", settings.json, "write all figures to this file");
  CLI11_PARSE(app, argc, argv);
  Benchmark(settings).run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("pipeline", run, argc, argv);
}
