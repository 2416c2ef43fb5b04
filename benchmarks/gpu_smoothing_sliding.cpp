// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "trismooth/smoothing/smooth.h"

#include "gpu_smoothing_experiments.h"

namespace benchmarks {

using namespace trismooth;

namespace {

/// One way to call it, with sliding or without.
struct Calls {
  Constraints constraints;
  SameBits& bits;
  std::optional<SmoothingPlan> prepared{};
  std::vector<double> whole{};
  std::vector<double> again{};
  SmoothingResult result{};

  void call(const RandomMesh& mesh, const SmoothingOptions& options, bool counts) {
    const auto points = flat_points(mesh);
    std::vector<double> xy(points.begin(), points.end());
    const double once =
        milliseconds_of([&] { result = smooth(xy_points(xy), flat_triangles(mesh), constraints, options); });
    bits.compare(xy);
    if (!prepared) {
      prepared = plan(vertex_count_of(mesh), flat_triangles(mesh), constraints, options);
    }
    xy.assign(points.begin(), points.end());
    const double planned = milliseconds_of([&] { prepared->smooth(xy); });
    bits.compare(xy);
    if (counts) {
      whole.push_back(once);
      again.push_back(planned);
    }
  }
};

double per_cent_more(const Spread& with, const Spread& without) {
  return 100 * (with.median / without.median - 1);
}

/// Runs without and with sliding in turn, so that a change of the machine's pace is in both.
void measure_sliding(Session& session, const RandomMesh& mesh, const std::string& execution, const std::string& form,
                     const std::string& precision, SameBits& held_bits, SameBits& slid_bits) {
  SmoothingOptions options = session.options(execution, "-", form, precision, mesh);
  options.topology = execution == "cpu" ? options.topology : Topology::device;
  Calls held{{}, held_bits};
  Calls slid{{}, slid_bits};
  slid.constraints.slide.along = Slide::straight;
  for (int run = -1; run < session.settings().runs; ++run) {  // the first warms up
    held.call(mesh, options, run >= 0);
    slid.call(mesh, options, run >= 0);
  }
  const Spread whole_held(held.whole);
  const Spread whole_slid(slid.whole);
  const Spread again_held(held.again);
  const Spread again_slid(slid.again);
  fmt::print(" {:>9} {:<8} {:<4} {:<6} {:>24} {:>24} {:>6.1f} {:>24} {:>24} {:>6.1f} {:>4} {:>4} {:>6}  {}\n",
             vertex_count_of(mesh), execution, form, precision, whole_held.text(), whole_slid.text(),
             per_cent_more(whole_slid, whole_held), again_held.text(), again_slid.text(),
             per_cent_more(again_slid, again_held), held.result.sweeps, slid.result.sweeps, slid.result.sliding->slid,
             slid.bits.hash());
  std::fflush(stdout);
  session.report()["sliding"].push_back({{"vertices", vertex_count_of(mesh)},
                                         {"execution", execution},
                                         {"form", form},
                                         {"precision", precision},
                                         {"method", session.settings().method},
                                         {"threads", slid.result.threads},
                                         {"runs", session.settings().runs},
                                         {"call_ms", json_of(whole_held)},
                                         {"sliding_call_ms", json_of(whole_slid)},
                                         {"plan_ms", json_of(again_held)},
                                         {"sliding_plan_ms", json_of(again_slid)},
                                         {"sweeps", held.result.sweeps},
                                         {"sliding_sweeps", slid.result.sweeps},
                                         {"slid", slid.result.sliding->slid},
                                         {"coordinates_hash", slid.bits.hash()}});
}

}  // namespace

void slide_along(Session& session) {
  fmt::print(
      "\nvertices of sides slide (straight): milliseconds by the host's clock, median (least-most), host arrays in "
      "and\n"
      "out, without and with, and per cent more: a whole call (topology by the device), and a plan called again\n"
      " {:>9} {:<8} {:<4} {:<6} {:>24} {:>24} {:>6} {:>24} {:>24} {:>6} {:>4} {:>4} {:>6}  {}\n",
      "vertices", "on", "form", "prec.", "a call", "sliding", "%", "a plan", "sliding", "%", "sw.", "sw.", "slid",
      "hash");
  for (const std::int64_t vertices : session.sizes({1'000'000})) {
    for (const std::string& precision : session.settings().precisions) {
      for (const std::string& form : session.settings().forms) {
        SameBits held(session);
        SameBits slid(session);
        for (const char* const execution : {"cpu", "resident"}) {
          if (std::string(execution) == "cpu" || session.has_device()) {
            measure_sliding(session, session.mesh(vertices), execution, form, precision, held, slid);
          }
        }
      }
    }
  }
}

}  // namespace benchmarks
