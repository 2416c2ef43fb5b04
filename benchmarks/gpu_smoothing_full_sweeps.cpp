// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "trismooth/smoothing/smooth.h"

#include "gpu_smoothing_experiments.h"

namespace benchmarks {

using namespace trismooth;

namespace {

struct Sweeps {
  std::vector<double> milliseconds;
  SmoothingResult last;
};

Sweeps run_sweeps(Session& session, const RandomMesh& mesh, SmoothingOptions options, std::int64_t sweeps) {
  options.evaluation = Evaluation::all;
  options.max_sweeps = sweeps;
  options.tolerance = 0;  // so that they are not fewer
  SmoothingPlan prepared = plan(vertex_count_of(mesh), flat_triangles(mesh), {}, options);
  SameBits bits(session);
  std::vector<double> xy(flat_points(mesh).size());
  Sweeps measured;
  for (int run = 0; run < session.settings().runs; ++run) {
    std::ranges::copy(flat_points(mesh), xy.begin());
    measured.last = prepared.smooth(xy);
    measured.milliseconds.push_back(measured.last.timings.smooth);
    bits.compare(xy);
  }
  return measured;
}

void measure(Session& session, const RandomMesh& mesh, const std::string& precision) {
  const std::int64_t sweeps = session.settings().full_sweeps;
  SmoothingOptions options = session.options("resident", "-", "a", precision, mesh);
  const Sweeps once = run_sweeps(session, mesh, options, sweeps);
  const Sweeps twice = run_sweeps(session, mesh, options, 2 * sweeps);
  const auto updates = static_cast<double>(twice.last.vertex_updates - once.last.vertex_updates);
  std::vector<double> picoseconds;
  std::vector<double> with_the_rest;
  for (std::size_t run = 0; run < once.milliseconds.size(); ++run) {
    picoseconds.push_back((twice.milliseconds[run] - once.milliseconds[run]) * 1e9 / updates);
    with_the_rest.push_back(twice.milliseconds[run] * 1e9 / static_cast<double>(twice.last.vertex_updates));
  }
  const Spread of_sweeps(picoseconds);
  const double bytes = options.precision == Precision::single_precision ? 44 : 60;
  const auto share = [&](double ps) { return bytes / (ps * 1e-12) / session.bandwidth(); };
  fmt::print(" {:>9} {:<6} {:>5} {:>22} {:>22} {:>5.0f}   {:.3f} ({:.3f}-{:.3f})\n", vertex_count_of(mesh), precision,
             twice.last.sweeps - once.last.sweeps, of_sweeps.text(), Spread(with_the_rest).text(), bytes,
             share(of_sweeps.median), share(of_sweeps.most), share(of_sweeps.least));
  std::fflush(stdout);
  session.report()["full_sweeps"].push_back(
      {{"vertices", vertex_count_of(mesh)},
       {"form", "a"},
       {"precision", precision},
       {"method", session.settings().method},
       {"runs", session.settings().runs},
       {"sweeps", {once.last.sweeps, twice.last.sweeps}},
       {"vertex_updates", updates},
       {"ps_per_vertex_and_sweep", json_of(of_sweeps)},
       {"ps_with_entering_the_frame", json_of(Spread(with_the_rest))},
       {"bytes_per_vertex", bytes},
       {"share_of_copy_bandwidth",
        {{"median", share(of_sweeps.median)}, {"min", share(of_sweeps.most)}, {"max", share(of_sweeps.least)}}}});
}

}  // namespace

void sweep_fully(Session& session) {
  session.require_device();
  fmt::print(
      "\nfull sweeps, Form A: picoseconds per vertex and sweep, device clock, median (least-most)\n"
      "\"sweeps\": (2 N sweeps - N sweeps) / N, nothing else in it; \"and frame\": 2 N sweeps with entering the frame\n"
      " {:>9} {:<6} {:>5} {:>22} {:>22} {:>5}   {}\n",
      "vertices", "prec.", "N", "sweeps", "and frame", "bytes", "share of the copy bandwidth");
  for (const std::int64_t vertices : session.sizes({4'000'000, 16'000'000})) {
    for (const std::string& precision : session.settings().precisions) {
      measure(session, session.mesh(vertices), precision);
    }
  }
}

}  // namespace benchmarks
