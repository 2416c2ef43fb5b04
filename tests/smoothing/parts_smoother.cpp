// SPDX-License-Identifier: BSD-3-Clause
// A mesh in parts that threads smooth is the whole mesh: every method, form and precision. Many random ones are among
// the properties; this one is small enough to watch the threads by.

#include "trismooth/smoothing/in_parts/parts_smoother.h"

#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/distorted_meshes.h"
#include "support/mixed_meshes.h"
#include "support/parts_backend.h"
#include "support/same_bits.h"

namespace trismooth::parts_smoother_test {

using parts_backend::PartsBackend;

struct Outcome {
  std::vector<double> xy;
  SmoothingResult result;
};

Outcome smoothed(const test_meshes::Mesh& mesh, const SmoothingOptions& options) {
  Outcome outcome{mesh.xy(), {}};
  outcome.result = trismooth::smooth(trismooth::xy_points(outcome.xy), mesh.indices(), options);
  return outcome;
}

TEST_CASE("a mesh in parts comes out as the whole by every method, form and precision") {
  const test_meshes::Mesh mesh = distorted_meshes::displaced(60, 0.2, 5);
  const PartsBackend in_parts(4);
  for (int index = 0; index < 16; ++index) {
    SmoothingOptions options;
    options.method = static_cast<trismooth::Method>(index % 4);
    options.form = static_cast<trismooth::Form>(index / 4 % 2);
    options.precision = static_cast<trismooth::Precision>(index / 8);
    options.record_min_shape = true;
    options.threads = 4;
    CAPTURE(index);
    const Outcome whole = smoothed(mesh, options);
    options.backend = &in_parts;
    const Outcome parts = smoothed(mesh, options);
    CHECK(whole.result.moved_vertices > 3000);
    CHECK(parts.result.sweeps == whole.result.sweeps);
    CHECK(parts.result.moved_vertices == whole.result.moved_vertices);
    CHECK(parts.result.history.back().min_shape == whole.result.history.back().min_shape);
    CHECK(same_bits(parts.xy, whole.xy));
  }
}

TEST_CASE("a mesh with quadrilaterals in parts comes out as the whole by every method, form and precision") {
  std::vector<mixed_meshes::MixedMesh> meshes;
  meshes.emplace_back(60, 50, 0.4, 5);
  meshes.push_back(mixed_meshes::MixedMesh(40, 30, 0.4, 2, 0).listed_from_other_corners(7, true));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    meshes.push_back(mixed_meshes::random_mesh(seed));
  }
  std::int64_t moved = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const mixed_meshes::MixedMesh& mesh = meshes[m];
    const PartsBackend in_parts(2 + static_cast<int>(m % 4));
    const auto smoothed = [&](const SmoothingOptions& options) {
      Outcome outcome{mesh.xy(), {}};
      outcome.result = trismooth::smooth(trismooth::xy_points(outcome.xy), mesh.elements, options);
      return outcome;
    };
    for (int index = 0; index < 32; ++index) {
      SmoothingOptions options;
      options.method = static_cast<trismooth::Method>(index % 4);
      options.form = static_cast<trismooth::Form>(index / 4 % 2);
      options.precision = static_cast<trismooth::Precision>(index / 8 % 2);
      options.mean_ratio.target = static_cast<TargetShape>(index / 16);
      options.record_min_shape = true;
      options.untangle = Untangle::off;
      options.threads = 4;
      options.max_sweeps = 20;
      CAPTURE(m, index);
      const Outcome whole = smoothed(options);
      options.backend = &in_parts;
      const Outcome parts = smoothed(options);
      CHECK(parts.result.sweeps == whole.result.sweeps);
      CHECK(parts.result.moved_vertices == whole.result.moved_vertices);
      CHECK(parts.result.reverted_vertices == whole.result.reverted_vertices);
      CHECK(parts.result.quadrilaterals == whole.result.quadrilaterals);
      CHECK(parts.result.history.back().min_shape == whole.result.history.back().min_shape);
      CHECK(same_bits(parts.xy, whole.xy));
      moved += whole.result.moved_vertices;
    }
  }
  CHECK(moved > 100000);
}

TEST_CASE("what the parts of a mesh have done until a call is cancelled is kept") {
  const test_meshes::Mesh mesh = distorted_meshes::displaced(60, 0.2, 5);
  const PartsBackend in_parts(3);
  SmoothingOptions options;
  options.backend = &in_parts;
  bool is_wanted = true;
  options.cancel = [&is_wanted] { return !is_wanted; };
  options.progress = [&is_wanted](const SweepRecord&) {
    is_wanted = false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // so long that it is asked again
    return Progress::stop;
  };
  const Outcome parts = smoothed(mesh, options);
  CHECK(parts.result.stop_reason == StopReason::cancelled);
  CHECK(parts.result.sweeps == 1);
  SmoothingOptions one_sweep;
  one_sweep.max_sweeps = 1;
  CHECK(same_bits(parts.xy, smoothed(mesh, one_sweep).xy));
}

TEST_CASE("a length to aim at that is no number is told by the vertex's number in the whole mesh") {
  const test_meshes::Mesh mesh = distorted_meshes::displaced(10, 0.2, 1);
  std::vector<double> lengths(mesh.points.size(), 1.0);
  lengths[77] = -1;
  const PartsBackend in_parts(5);
  SmoothingOptions options;
  options.method = trismooth::Method::mean_ratio;
  options.mean_ratio.target_lengths = lengths;
  options.backend = &in_parts;
  CHECK_THROWS_WITH(smoothed(mesh, options),
                    "MeanRatioOptions::target_lengths: that of vertex 77 is not a positive number");
}

}  // namespace trismooth::parts_smoother_test
