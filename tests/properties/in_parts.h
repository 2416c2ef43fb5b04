// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/smoothing/backend.h"

#include "properties/smoothing_cases.h"
#include "support/parts_backend.h"

/// Meshes that this process has as a whole, smoothed in parts by threads of it.
namespace properties {

using parts_backend::PartsBackend;

/// Smooths the mesh by the backend and as a whole by the CPU: what differs, or nothing. `untangles`: the backend does
/// that, too; else it is to refuse tangled meshes, and to leave their points alone.
inline std::string difference_in_parts(const RandomMesh& mesh, SmoothingOptions options, Storage storage,
                                       const trismooth::Backend& backend, bool untangles) {
  const Run expected = run(mesh, options, storage);
  options.backend = &backend;
  const bool is_refused = !untangles && expected.result.untangling && expected.result.untangling->inverted_before > 0;
  auto plan = trismooth::plan(mesh.mesh.vertex_count(), mesh.mesh.indices(), mesh.constraints(), options);
  for (int times = 0; times < 2; ++times) {
    Run found{mesh.mesh.xy(), {}};
    try {
      found.result = plan.smooth(found.xy, storage);
      if (is_refused) {
        return "a tangled mesh was taken";
      }
    } catch (const std::invalid_argument& error) {
      if (!is_refused) {
        return error.what();
      }
      const std::string moved = difference(found.xy, mesh.mesh.xy());
      if (!moved.empty()) {
        return "refused, and moved: " + moved;
      }
      continue;
    }
    if (const std::string wrong = difference(found, expected); !wrong.empty()) {
      return (times > 0 ? "the plan again: " : "") + wrong;
    }
  }
  return {};
}

/// Any options, and lengths to aim at, which `lengths` is filled with.
inline void draw_for_parts(const RandomMesh& mesh, SmoothingOptions& options, std::vector<double>& lengths,
                           test_meshes::Random& random) {
  options.record_min_shape = random.below(3) == 0;
  options.guard = random.below(5) != 0;
  options.threads = 1 + random.below(3);
  options.evaluation = random.below(4) == 0 ? trismooth::Evaluation::all : trismooth::Evaluation::changed;
  if (random.below(5) == 0) {
    options.target_quality = random.between(-0.2, 0.8);
  }
  if (random.below(8) == 0) {
    const std::int64_t last = 1 + random.below(8);
    options.progress = [last](const trismooth::SweepRecord& record) {
      return record.sweep == last ? trismooth::Progress::stop : trismooth::Progress::proceed;
    };
  }
  if (options.method == Method::mean_ratio && random.below(3) == 0) {
    lengths.clear();
    for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
      lengths.push_back(std::exp2(random.between(-2, 2)));
    }
    options.mean_ratio.target_lengths = lengths;
  }
}

}  // namespace properties
