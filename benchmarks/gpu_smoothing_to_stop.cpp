// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "trismooth/smoothing/smooth.h"

#include "gpu_smoothing_experiments.h"

namespace benchmarks {

using namespace trismooth;

namespace {

void measure(Session& session, const RandomMesh& mesh, const std::string& execution, const std::string& layout,
             const std::string& form, const std::string& precision, SameBits& bits) {
  const Settings& settings = session.settings();
  const SmoothingOptions options = session.options(execution, layout, form, precision, mesh);
  if (session.has_device()) {
    most_memory_used();
  }
  SmoothingPlan prepared = plan(vertex_count_of(mesh), flat_triangles(mesh), {}, options);
  std::vector<double> in;
  std::vector<double> sweeps;
  std::vector<double> commit;
  std::vector<double> out;
  std::vector<double> total;
  SmoothingResult result;
  double prepare = 0;
  for (int run = 0; run < settings.runs; ++run) {
    const auto points = flat_points(mesh);
    std::vector<double> xy(points.begin(), points.end());
    result = prepared.smooth(xy);
    prepare = run == 0 ? result.timings.prepare : prepare;
    in.push_back(result.timings.transfer_in);
    sweeps.push_back(result.timings.smooth);
    commit.push_back(result.timings.commit);
    out.push_back(result.timings.transfer_out);
    total.push_back(result.timings.smooth + result.timings.commit);
    bits.compare(xy);
  }
  const double per_vertex = static_cast<double>(session.has_device() ? most_memory_used() : 0) / vertex_count_of(mesh);
  const Spread all(total);
  const auto updates = static_cast<double>(std::max<std::int64_t>(1, result.vertex_updates));
  const std::string hash = bits.hash();
  fmt::print(
      " {:<12} {:<4} {:<4} {:<6} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>24} {:>6} {:>7.2f} {:>8.1f} {:>6.1f}  "
      "{}\n",
      execution, layout, form, precision, prepare, Spread(in).median, Spread(sweeps).median, Spread(commit).median,
      Spread(out).median, all.text(), result.sweeps,
      static_cast<double>(result.vertex_updates) / static_cast<double>(result.free_vertices),
      Spread(sweeps).median * 1e9 / updates, per_vertex, hash);
  std::fflush(stdout);
  session.report()["rows"].push_back({{"vertices", vertex_count_of(mesh)},
                                      {"execution", execution},
                                      {"layout", layout},
                                      {"form", form},
                                      {"precision", precision},
                                      {"method", settings.method},
                                      {"topology", options.topology == Topology::device ? "device" : "host"},
                                      {"evaluation", settings.evaluation},
                                      {"threads", result.threads},
                                      {"device", result.device},
                                      {"runs", settings.runs},
                                      {"sweeps", result.sweeps},
                                      {"stop_reason", std::string(to_string(result.stop_reason))},
                                      {"vertex_updates", result.vertex_updates},
                                      {"free_vertices", result.free_vertices},
                                      {"kernel_launches", result.kernel_launches},
                                      {"child_launches", result.child_launches},
                                      {"prepare_ms", prepare},
                                      {"transfer_in_ms", json_of(Spread(in))},
                                      {"sweeps_ms", json_of(Spread(sweeps))},
                                      {"commit_ms", json_of(Spread(commit))},
                                      {"transfer_out_ms", json_of(Spread(out))},
                                      {"sweeps_and_commit_ms", json_of(all)},
                                      {"device_bytes_per_vertex", per_vertex},
                                      {"coordinates_hash", hash}});
}

}  // namespace

void smooth_to_stop(Session& session) {
  const Settings& settings = session.settings();
  for (const std::int64_t vertices : session.sizes({1'000, 10'000, 100'000, 1'000'000})) {
    const RandomMesh& mesh = session.mesh(vertices);
    fmt::print("\nto its stop: {} vertices, {} triangles; milliseconds, median (least-most) of sweeps and commit\n",
               mesh.points.size(), mesh.triangles.size());
    fmt::print(" {:<12} {:<4} {:<4} {:<6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>24} {:>6} {:>7} {:>8} {:>6}  {}\n",
               "execution", "lay.", "form", "prec.", "prepare", "in", "sweeps", "commit", "out", "sweeps and commit",
               "sweeps", "updates", "ps/upd.", "B/vtx", "hash");
    for (const std::string& precision : settings.precisions) {
      for (const std::string& form : settings.forms) {
        SameBits bits(session);
        for (const std::string& execution : settings.executions) {
          const bool on_cpu = execution == "cpu";
          const bool has_layouts = !on_cpu && execution != "resident";
          for (const std::string& layout : has_layouts ? settings.layouts : std::vector<std::string>{"-"}) {
            if (on_cpu || session.has_device()) {
              measure(session, mesh, execution, layout, form, precision, bits);
            }
          }
        }
      }
    }
  }
}

}  // namespace benchmarks
