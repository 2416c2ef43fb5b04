// SPDX-License-Identifier: BSD-3-Clause
// Measures smoothing on a CUDA device beside the CPU, on random Delaunay meshes (the paper's test data; mirrored tiles
// above 4M vertices), and checks on the way that every run gives the same bits.
//
//     gpu_smoothing --vertices 100000 1000000 --precision single --executions resident --runs 7 --json results.json
//     gpu_smoothing --experiments full-sweeps rings host-arrays plan sliding serial --json results.json
//
// The experiments are described in gpu_smoothing_experiments.h; each has its own sizes unless --vertices gives them.
// "to-stop": times are those of the device's own clock. A mesh is analysed and packed once ("prepare"); then its
// coordinates are smoothed --runs times. "sweeps" and "commit" are what smoothing takes on the device (entering the
// local frame counts as sweeps); the copies of the coordinates there and back are given apart. Everywhere the median
// stands before the least and the most. The bandwidth of a copy in device memory, measured in the same run, stands
// above them: a sweep over all vertices moves 44 bytes a vertex in single precision and 60 in double at least.

#include <array>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "gpu_smoothing_experiments.h"
#include "run_reporting.h"

namespace {

using namespace benchmarks;

constexpr std::array<std::pair<const char*, void (*)(Session&)>, 7> experiments{{{"to-stop", &smooth_to_stop},
                                                                                 {"full-sweeps", &sweep_fully},
                                                                                 {"rings", &find_rings},
                                                                                 {"host-arrays", &smooth_host_arrays},
                                                                                 {"plan", &call_plan_again},
                                                                                 {"sliding", &slide_along},
                                                                                 {"serial", &compare_with_serial}}};

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  names.reserve(experiments.size());
  for (const auto& [name, run] : experiments) {
    names.emplace_back(name);
  }
  return names;
}

bool run_experiments(const Settings& settings) {
  Session session(settings);
  for (const std::string& wanted : settings.experiments) {
    for (const auto& [name, run] : experiments) {
      if (wanted == name) {
        run(session);
      }
    }
    // After each, so that an error in a later one loses nothing.
    if (!settings.json.empty()) {
      std::ofstream(settings.json) << session.report().dump(1) << '\n';
    }
  }
  fmt::print("\nbits: {}\n", session.same_bits() ? "every run of a form and precision gave the same" : "DIFFERENT");
  return session.same_bits();
}

int run(int argc, char** argv) {
  CLI::App app("Measures smoothing on a CUDA device beside the CPU");
  Settings settings;
  app.add_option("--experiments", settings.experiments)
      ->check(CLI::IsMember(experiment_names()))
      ->capture_default_str();
  app.add_option("--vertices", settings.vertices, "default: those of each experiment");
  app.add_option("--executions", settings.executions,
                 "of to-stop: cpu, resident, and of smart and laplacian single-block, cdp")
      ->capture_default_str();
  app.add_option("--layouts", settings.layouts, "of single-block and cdp")->capture_default_str();
  app.add_option("--forms", settings.forms, "of all but full-sweeps, which is Form A")->capture_default_str();
  app.add_option("--precisions", settings.precisions)->capture_default_str();
  app.add_option("--method", settings.method)->capture_default_str();
  app.add_option("--boundary", settings.boundary, "of the meshes: random, resolved")->capture_default_str();
  app.add_option("--topology", settings.topology, "host, device, or auto: device from 4,000,000 vertices on")
      ->capture_default_str();
  app.add_option("--evaluation", settings.evaluation, "changed, or all: every vertex in every sweep")
      ->check(CLI::IsMember({"changed", "all"}))
      ->capture_default_str();
  app.add_option("--max-sweeps", settings.max_sweeps)->capture_default_str();
  app.add_option("--full-sweeps", settings.full_sweeps, "N of the experiment full-sweeps")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--runs", settings.runs)->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--threads", settings.threads, "of the CPU rows; 0: one for each core")->capture_default_str();
  app.add_option("--json", settings.json, "write all figures to this file");
  CLI11_PARSE(app, argc, argv);
  return run_experiments(settings) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("gpu_smoothing", run, argc, argv);
}
