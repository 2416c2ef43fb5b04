// SPDX-License-Identifier: BSD-3-Clause
// Runs every combination of method, form, precision, execution, its layouts and topology on a device and compares the
// bits of the result, before and after the guard, with the CPU's. Prints one row for each. A row counts only if the
// report names a GPU and counts launches. Form B in no fixed order is held to the contract alone.
//
//     test_cuda_combinations [--vertices N...] [--mesh FILE...] [--max-sweeps N]
//
// Exit status 77: no device, skipped.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/cuda/backend.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/mesh_io/halfedge/halfedge_rings.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/guard/guard_rule.h"
#include "trismooth/smoothing/rings/fixed_vertices.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "device_ways.h"

namespace {

using namespace trismooth;
using namespace device_ways;

constexpr int skipped = 77;

/// What a run is known by.
struct Outcome {
  std::uint64_t committed = 0;
  std::uint64_t uncommitted = 0;
  SmoothingResult result;
};

/// A mesh that can be smoothed with any options.
class TestMesh {
 public:
  TestMesh() = default;
  TestMesh(const TestMesh&) = delete;
  TestMesh& operator=(const TestMesh&) = delete;
  virtual ~TestMesh() = default;
  virtual std::string name() const = 0;
  virtual Outcome smooth(const SmoothingOptions& options) = 0;
  /// What is wrong with the last result by the contract (never worse, fixed vertices unmoved, finite); empty: nothing.
  virtual std::string breach() const = 0;
};

/// A random Delaunay mesh in memory, its rings found in all three ways.
class DelaunayMesh final : public TestMesh {
 public:
  explicit DelaunayMesh(std::int64_t vertices) : mesh_(random_delaunay_mesh(vertices, 1)) {
    local_ = entered(local_frame(mesh_.points), mesh_.points);
    Workers workers(0);
    std::vector<double> xyz;
    for (const Point2<double> p : mesh_.points) {
      xyz.insert(xyz.end(), {p.x, p.y, 0.0});
    }
    by_halfedges_ = read_halfedge_rings(connect_halfedges(xyz, mesh_.triangles, workers), local_.points,
                                        mesh_.triangles, {}, workers);
    SmoothingOptions options;
    in_parallel_ = *cuda::backend().find_rings(local_.points, mesh_.triangles, {}, options);
    options.execution = Execution::single_block;
    by_one_thread_ = *cuda::backend().find_rings(local_.points, mesh_.triangles, {}, options);
  }

  std::string name() const override { return fmt::format("delaunay {}", mesh_.points.size()); }

  Outcome smooth(const SmoothingOptions& options) override {
    const MeshRings& by_device = options.execution == Execution::single_block ? by_one_thread_ : in_parallel_;
    const MeshRings& found = options.topology == Topology::device ? by_device : by_halfedges_;
    smoothed_ = mesh_.points;
    Outcome outcome;
    outcome.result = backend_of(options)
                         .prepare(found, mesh_.triangles, local_.points, options)
                         ->smooth(smoothed_, Storage::float64, local_.frame);
    outcome.committed = hash(smoothed_);
    uncommitted_ = smoothed_;
    for (const auto& [vertex, position] : outcome.result.reverted) {
      uncommitted_[static_cast<std::size_t>(vertex)] = position;
    }
    outcome.uncommitted = hash(uncommitted_);
    return outcome;
  }

  std::string breach() const override {
    double threshold = std::numeric_limits<double>::infinity();
    const auto moved = [&](std::int32_t v) { return !(smoothed_[v] == mesh_.points[v]); };
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(smoothed_.size()); ++v) {
      if (!std::isfinite(smoothed_[v].x) || !std::isfinite(smoothed_[v].y)) {
        return "not finite";
      }
      if (by_halfedges_.fixed[v] != 0 && moved(v)) {
        return "a fixed vertex moved";
      }
    }
    for (const auto& [a, b, c] : mesh_.triangles) {
      if (moved(a) || moved(b) || moved(c)) {
        threshold = std::min(threshold, quotient(mesh_.points, a, b, c));
      }
    }
    for (const auto& [a, b, c] : mesh_.triangles) {
      if (offends(quotient(mesh_.points, a, b, c), quotient(smoothed_, a, b, c), threshold)) {
        return "an element got worse";
      }
    }
    return {};
  }

 private:
  static double quotient(const std::vector<Point2<double>>& points, std::int32_t a, std::int32_t b, std::int32_t c) {
    return shape_quotient(points_of(canonical_corners(Triangle{a, b, c}, false), points));
  }
  static std::uint64_t hash(const std::vector<Point2<double>>& points) {
    std::vector<double> xyz;
    xyz.reserve(3 * points.size());
    for (const Point2<double> p : points) {
      xyz.insert(xyz.end(), {p.x, p.y, 0.0});
    }
    return coordinates_hash(xyz);
  }

  RandomMesh mesh_;
  LocalPoints local_;
  std::vector<Point2<double>> smoothed_;
  std::vector<Point2<double>> uncommitted_;
  MeshRings by_halfedges_;
  MeshRings in_parallel_;
  MeshRings by_one_thread_;
};

/// A mesh file, through the whole pipeline.
class FileMesh final : public TestMesh {
 public:
  explicit FileMesh(const std::filesystem::path& path) : output_(std::filesystem::temp_directory_path()) {
    pipeline_.input = path;
    pipeline_.output = output_ / ("combination" + path.extension().string());
  }
  ~FileMesh() override {
    std::error_code ignored;
    std::filesystem::remove(*pipeline_.output, ignored);
  }

  std::string name() const override { return pipeline_.input.filename().string(); }

  Outcome smooth(const SmoothingOptions& options) override {
    pipeline_.smoothing = options;
    last_ = run_pipeline(pipeline_);
    return {last_.coordinates_hash, last_.unguarded_hash, *last_.smoothing};
  }

  std::string breach() const override {
    // Fixed vertices and single elements are looked at for the meshes in memory; here what the report says.
    if (last_.after->inverted > last_.before.inverted) {
      return "more inverted elements";
    }
    if (!(last_.after->worst.front().shape >= last_.before.worst.front().shape)) {
      return "the worst element got worse";
    }
    return {};
  }

 private:
  std::filesystem::path output_;
  PipelineOptions pipeline_;
  PipelineResult last_;
};

class Table {
 public:
  void print_head() const {
    fmt::print("{:<20} {:<9} {:<4} {:<6} {:<12} {:<6} {:<8} {:<16} {:<16} {:>6} {:>8} {:>8} {:>9}  {}\n", "mesh",
               "method", "form", "prec.", "execution", "layout", "topology", "committed", "uncommitted", "sweeps",
               "launches", "children", "ms", "verdict");
  }

  void row(const std::string& mesh, const SmoothingOptions& options, const Outcome& outcome,
           const std::string& execution, const std::string& verdict) {
    const bool on_cpu = outcome.result.backend == "cpu";
    fmt::print("{:<20} {:<9} {:<4} {:<6} {:<12} {:<6} {:<8} {} {} {:>6} {:>8} {:>8} {:>9.3f}  {}\n", mesh,
               to_string(options.method), to_string(options.form), to_string(options.precision), execution,
               on_cpu ? "" : to_string(options.layout), on_cpu ? "" : to_string(options.topology),
               hash_text(outcome.committed), hash_text(outcome.uncommitted), outcome.result.sweeps,
               outcome.result.kernel_launches, outcome.result.child_launches,
               outcome.result.timings.smooth + outcome.result.timings.commit, verdict);
    std::fflush(stdout);
  }

  /// Whether the report says that a device did it, and with dynamic parallelism where that was asked for.
  static bool ran_on_device(const SmoothingOptions& options, const SmoothingResult& result) {
    return result.backend == "cuda" && !result.device.empty() && result.kernel_launches > 0 &&
           (options.execution != Execution::cdp || result.child_launches > 0);
  }

  void compare(TestMesh& mesh, SmoothingOptions options) {
    options.backend = nullptr;
    const Outcome expected = mesh.smooth(options);
    row(mesh.name(), options, expected, "cpu", "reference");
    options.backend = &cuda::backend();
    for (const DeviceWay& way : every_way(options.method)) {
      for (const Topology topology : {Topology::host, Topology::device}) {
        way.choose_in(options);
        options.topology = topology;
        const Outcome outcome = mesh.smooth(options);
        const bool same = outcome.committed == expected.committed && outcome.uncommitted == expected.uncommitted &&
                          outcome.result.sweeps == expected.result.sweeps &&
                          outcome.result.stop_reason == expected.result.stop_reason &&
                          outcome.result.moved_vertices == expected.result.moved_vertices &&
                          outcome.result.guard_rounds == expected.result.guard_rounds;
        const bool counts = ran_on_device(options, outcome.result);
        ++rows_;
        equal_ += same && counts ? 1 : 0;
        row(mesh.name(), options, outcome, std::string(to_string(way.execution)),
            !counts ? "NOT ON A GPU" : (same ? "equal" : "DIFFERENT"));
      }
    }
  }

  void hold_to_contract(TestMesh& mesh, SmoothingOptions options) {
    options.backend = &cuda::backend();
    options.form = Form::in_place;
    options.order = Order::unordered;
    for (const DeviceWay& way : paper_ways()) {
      way.choose_in(options);
      const Outcome outcome = mesh.smooth(options);
      const std::string breach = mesh.breach();
      const bool counts = ran_on_device(options, outcome.result) && !outcome.result.reproducible;
      ++unordered_rows_;
      kept_ += breach.empty() && counts ? 1 : 0;
      row(mesh.name(), options, outcome, std::string(to_string(way.execution)) + "*",
          !counts ? "NOT ON A GPU" : (breach.empty() ? "contract kept" : "BROKEN: " + breach));
    }
  }

  void all_of(TestMesh& mesh, std::int64_t max_sweeps) {
    SmoothingOptions options;
    options.max_sweeps = max_sweeps;
    options.untangle = Untangle::off;  // tangled meshes would go to the host
    for (const Method method : trismooth::values_of<Method>()) {
      for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        options.method = method;
        options.precision = precision;
        for (const Form form : {Form::swap, Form::in_place}) {
          options.form = form;
          compare(mesh, options);
        }
        if (is_of_paper(method)) {
          hold_to_contract(mesh, options);
        }
      }
    }
  }

  bool print_verdict() const {
    fmt::print("\n{} of {} rows have the CPU's bits; {} of {} unordered rows (*) keep the contract\n", equal_, rows_,
               kept_, unordered_rows_);
    return equal_ == rows_ && kept_ == unordered_rows_;
  }

 private:
  int rows_ = 0;
  int equal_ = 0;
  int unordered_rows_ = 0;
  int kept_ = 0;
};

int run(int argc, char** argv) {
  CLI::App app("Compares every combination on a CUDA device with the CPU, bit for bit");
  std::vector<std::int64_t> sizes{1'000, 10'000};
  std::vector<std::filesystem::path> files;
  std::int64_t max_sweeps = 200;
  app.add_option("--vertices", sizes, "random Delaunay meshes of so many vertices")->capture_default_str();
  app.add_option("--mesh", files, "mesh files");
  app.add_option("--max-sweeps", max_sweeps)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const cuda::DeviceSurvey survey = cuda::survey_devices();
  if (survey.devices.empty()) {
    fmt::print("skipped: {}\n", survey.problem);
    return skipped;
  }
  fmt::print("device: {}\n", survey.devices.front().name);
  Table table;
  table.print_head();
  for (const std::int64_t size : sizes) {
    DelaunayMesh mesh(size);
    table.all_of(mesh, max_sweeps);
  }
  for (const std::filesystem::path& file : files) {
    FileMesh mesh(file);
    table.all_of(mesh, max_sweeps);
  }
  return table.print_verdict() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "test_cuda_combinations: error: %s\n", error.what());
    return 1;
  }
}
