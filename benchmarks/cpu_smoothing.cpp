// SPDX-License-Identifier: BSD-3-Clause
// Measures the CPU path on random Delaunay meshes (the paper's test data), stage by stage and by number of threads, and
// checks on the way that every run gives the same bits.
//
//     cpu_smoothing --vertices 100000 1000000 --threads 1 2 --form b --precision double --runs 7

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/halfedge/halfedge_mesh.h"
#include "trismooth/pipeline/coordinates_hash.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/report/spread.h"
#include "trismooth/smoothing/rings/listed_rings.h"
#include "trismooth/smoothing/smooth.h"

#include "run_reporting.h"

namespace {

using namespace trismooth;

struct Settings {
  std::vector<std::int64_t> vertices{100'000, 1'000'000};
  std::vector<int> threads{1, 2};
  std::string method = "smart";
  std::string boundary = "random";
  std::string form = "b";
  std::string precision = "double";
  std::string evaluation = "changed";
  int runs = 7;
};

double milliseconds(const std::function<void()>& body) {
  const Stopwatch watch;
  body();
  return watch.milliseconds();
}

/// Times of one kind of work over several runs.
class Series {
 public:
  explicit Series(std::string name) : name_(std::move(name)) {}
  void add(double value) { values_.push_back(value); }
  void print() const {
    const Spread s(values_);
    fmt::print("  {:<34}{:>10.1f} ms   ({:.1f} to {:.1f})\n", name_, s.median, s.least, s.most);
  }
  double median() const { return Spread(values_).median; }

 private:
  std::string name_;
  std::vector<double> values_;
};

void bench_topology(const RandomMesh& mesh, int runs) {
  const auto n = static_cast<std::int32_t>(mesh.points.size());
  std::vector<double> xyz;
  for (const Point2<double> p : mesh.points) {
    xyz.insert(xyz.end(), {p.x, p.y, 0.0});
  }
  Workers workers(1);
  Series match("connect triangles");
  Series fill("fill halfedge mesh");
  Series rings("one-rings from halfedges");
  for (int run = 0; run < runs; ++run) {
    TriangleTopology topology;
    match.add(milliseconds([&] { topology = *find_listed_topology(n, mesh.triangles, workers); }));
    const Stopwatch watch;
    const HalfedgeMesh halfedges = build_halfedge_mesh(xyz, mesh.triangles, topology, topology.parity, workers);
    fill.add(watch.milliseconds());
    rings.add(milliseconds([&] { one_rings(halfedges, topology.degree, topology.hold, {}, workers); }));
  }
  fmt::print(" topology, one thread\n");
  match.print();
  fill.print();
  rings.print();
}

/// Median time of sweeps and commit together; the hash of the result goes to `hashes`.
double bench_smoothing(const RandomMesh& mesh, const Settings& settings, int threads,
                       std::vector<std::uint64_t>& hashes) {
  SmoothingOptions options;
  options.method = parse_enum<Method>(settings.method);
  options.form = parse_enum<Form>(settings.form);
  options.precision = parse_enum<Precision>(settings.precision);
  options.evaluation = settings.evaluation == "all" ? Evaluation::all : Evaluation::changed;
  options.threads = threads;
  Series prepare("renumber, colour, pack");
  Series sweeps("sweeps");
  Series commit("never-worse commit");
  Series both("sweeps and commit");
  SmoothingResult result;
  for (int run = 0; run < settings.runs; ++run) {
    const auto points = flat_points(mesh);
    std::vector<double> xy(points.begin(), points.end());
    result = smooth(xy_points(xy), flat_triangles(mesh), {}, options);
    hashes.push_back(coordinates_hash(xy));
    prepare.add(result.timings.prepare);
    sweeps.add(result.timings.smooth);
    commit.add(result.timings.commit);
    both.add(result.timings.smooth + result.timings.commit);
  }
  fmt::print(" smoothing, {} thread{} of {}: {} sweeps ({}), {:.2f} updates a vertex, {:.1f} % moved, {} reverted\n",
             threads, threads == 1 ? "" : "s", result.device, result.sweeps, to_string(result.stop_reason),
             static_cast<double>(result.vertex_updates) / static_cast<double>(result.free_vertices),
             100.0 * static_cast<double>(result.moved_vertices) / static_cast<double>(result.free_vertices),
             result.reverted_vertices);
  prepare.print();
  sweeps.print();
  commit.print();
  both.print();
  return both.median();
}

void bench_mesh(std::int64_t vertices, const Settings& settings) {
  RandomMesh mesh;
  const double generating = milliseconds(
      [&] { mesh = random_delaunay_mesh(vertices, 1, {parse_enum<GeneratedBoundary>(settings.boundary)}); });
  fmt::print("{} vertices, {} triangles, generated in {:.0f} ms\n", mesh.points.size(), mesh.triangles.size(),
             generating);
  bench_topology(mesh, settings.runs);
  std::vector<std::uint64_t> hashes;
  double first = 0;
  for (const int threads : settings.threads) {
    const double median = bench_smoothing(mesh, settings, threads, hashes);
    first = first == 0 ? median : first;
    fmt::print("  {:<34}{:>10.2f} times the speed of {} thread(s)\n", "", first / median, settings.threads.front());
  }
  const bool same = std::ranges::adjacent_find(hashes, std::not_equal_to<>()) == hashes.end();
  fmt::print(" bits: {} runs, {}\n\n", hashes.size(), same ? "all the same" : "DIFFERENT");
}

int run(int argc, char** argv) {
  CLI::App app("Measures the CPU path on random Delaunay meshes");
  Settings settings;
  app.add_option("--vertices", settings.vertices, "mesh sizes")->capture_default_str();
  app.add_option("--threads", settings.threads, "numbers of threads")->capture_default_str();
  app.add_option("--method", settings.method)->capture_default_str();
  app.add_option("--boundary", settings.boundary, "of the meshes: random, resolved")->capture_default_str();
  app.add_option("--form", settings.form)->capture_default_str();
  app.add_option("--precision", settings.precision)->capture_default_str();
  app.add_option("--evaluation", settings.evaluation, "changed, or all: every vertex in every sweep")
      ->check(CLI::IsMember({"changed", "all"}))
      ->capture_default_str();
  app.add_option("--runs", settings.runs)->capture_default_str()->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  for (const std::int64_t vertices : settings.vertices) {
    bench_mesh(vertices, settings);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("cpu_smoothing", run, argc, argv);
}
