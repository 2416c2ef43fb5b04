// SPDX-License-Identifier: BSD-3-Clause
// What share of tangled meshes is untangled, by domain and by what tangled them, and how long it takes.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/untangle/untangle.h"

#include "run_reporting.h"
#include "support/tangled_meshes.h"

namespace {

using namespace trismooth;
using namespace tangled_meshes;

/// The runs of one domain, one tangle and one size.
struct Tally {
  int runs = 0;
  int solved = 0;
  std::int64_t inverted_before = 0;
  std::int64_t inverted_after = 0;
  UntangleOutcome means;
  double milliseconds = 0;
  double most_milliseconds = 0;
  double smallest_shape = std::numeric_limits<double>::infinity();
};

/// What every run has in common.
struct Settings {
  std::vector<std::int32_t> sizes{100, 1000, 10000, 100000};
  int threads = 0;
  int meshes = 100;
  std::int32_t held_folds = 0;
  std::string domain;
  std::string tangle;
  std::string elements = "triangles";
};

/// The rings of elements of one list.
template <class Corners>
OneRings rings_of(std::span<const Corners> elements, const ValidMesh& valid, Workers& workers) {
  const TriangleTopology topology = connect_triangles(valid.mesh.vertex_count(), elements, workers);
  const std::vector<std::uint8_t> reversed(elements.size(), 0);
  return one_rings(topology, elements, reversed, valid.fixed, workers);
}

void run(Domain domain, Tangle tangle, std::int32_t vertices, std::uint64_t seed, const Settings& settings,
         Workers& workers, Tally& tally) {
  ValidMesh valid = valid_mesh(domain, vertices, seed);
  fold_by_held_vertices(valid, settings.held_folds, seed);
  ElementList elements = valid.mesh.triangles;
  CutMesh cut;
  if (settings.elements != "triangles") {
    cut = cut_in_quadrilaterals(valid);
    valid = cut.in_triangles;
    elements = settings.elements == "quadrilaterals" ? ElementList(cut.quadrilaterals)
               : settings.elements == "both"         ? ElementList(cut.both)
                                                     : ElementList(valid.mesh.triangles);
  }
  const OneRings rings = elements.visit([&](const auto& listed) { return rings_of(listed, valid, workers); });
  std::vector<Point2<double>> points = tangled_points(valid, tangle, seed);
  const Stopwatch watch;
  const UntangleOutcome outcome = untangle(rings.view(), points, workers);
  const double milliseconds = watch.milliseconds();
  ++tally.runs;
  tally.solved += outcome.inverted_after == 0 ? 1 : 0;
  tally.inverted_before += outcome.inverted_before;
  tally.inverted_after += outcome.inverted_after;
  tally.means.by_averages += outcome.by_averages;
  tally.means.by_kernels += outcome.by_kernels;
  tally.means.by_embedding += outcome.by_embedding;
  tally.means.by_energy += outcome.by_energy;
  tally.milliseconds += milliseconds;
  tally.most_milliseconds = std::max(tally.most_milliseconds, milliseconds);
  elements.visit([&](const auto& listed) {
    for (const auto& corners : listed) {
      tally.smallest_shape = std::min(tally.smallest_shape, shape_constant * quotient_at(corners, points));
    }
  });
}

int measure(int argc, char** argv) {
  CLI::App app("The share of tangled meshes that is untangled");
  Settings settings;
  app.add_option("--vertices", settings.sizes, "sizes of the meshes");
  app.add_option("--threads", settings.threads, "0: one for each core");
  app.add_option("--meshes", settings.meshes,
                 "meshes of 100 vertices of a kind; a tenth for ten times the vertices, 2 at least");
  app.add_option("--elements", settings.elements,
                 "triangles; or each of them cut in three, with seven times the vertices: quadrilaterals, halves "
                 "(two triangles each), both")
      ->check(CLI::IsMember({"triangles", "quadrilaterals", "halves", "both"}));
  app.add_option("--domain", settings.domain, "this one alone");
  app.add_option("--tangle", settings.tangle, "this one alone");
  app.add_option("--held-folds", settings.held_folds, "places that fixed vertices fold: nothing mends these");
  CLI11_PARSE(app, argc, argv);
  Workers workers(settings.threads);
  fmt::print("{:<10} {:>8} {:<15} {:>9} {:>10} {:>8} {:>9} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "domain", "vertices",
             "tangled by", "solved", "inverted", "left", "averages", "kernels", "embedded", "energy", "ms", "most ms",
             "shape");
  for (const std::int32_t vertices : settings.sizes) {
    for (const Domain domain : all_domains) {
      if (!settings.domain.empty() && settings.domain != name_of(domain)) {
        continue;
      }
      for (const Tangle tangle : all_tangles) {
        if (!settings.tangle.empty() && settings.tangle != name_of(tangle)) {
          continue;
        }
        Tally tally;
        const int runs = std::max(2, static_cast<int>(std::int64_t{settings.meshes} * 100 / vertices));
        for (int i = 0; i < runs; ++i) {
          run(domain, tangle, vertices, static_cast<std::uint64_t>(i), settings, workers, tally);
        }
        fmt::print("{:<10} {:>8} {:<15} {:>4}/{:<4} {:>10} {:>8} {:>9} {:>8} {:>9} {:>9} {:>9.2f} {:>9.2f} {:>9.1e}\n",
                   name_of(domain), vertices, name_of(tangle), tally.solved, tally.runs, tally.inverted_before,
                   tally.inverted_after, tally.means.by_averages, tally.means.by_kernels, tally.means.by_embedding,
                   tally.means.by_energy, tally.milliseconds / tally.runs, tally.most_milliseconds,
                   tally.smallest_shape);
        std::fflush(stdout);
      }
    }
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("untangling", measure, argc, argv);
}
