// SPDX-License-Identifier: BSD-3-Clause
// A hash of the bits of every smoothing of many random meshes, and of their quality before and after, one mesh a line.
// compare.py holds this program, compiled for one instruction set, to itself, compiled for another.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>

#include <fmt/format.h>

#include "trismooth/base/splitmix64.h"
#include "trismooth/quality/quality_report.h"

#include "properties/smoothing_cases.h"
#include "support/random_meshes.h"

namespace {

class Hash {
 public:
  /// One NaN is as good as another: their signs are the processor's.
  void add(double value) {
    const double told = std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value;
    state_ = trismooth::splitmix64(state_ ^ std::bit_cast<std::uint64_t>(told));
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

void add_quality(Hash& hash, const properties::RandomMesh& mesh) {
  trismooth::QualityOptions options;
  options.threads = 1;
  const trismooth::QualityReport report =
      trismooth::quality_report({mesh.mesh.points, mesh.mesh.triangles, {}}, options);
  for (const trismooth::MetricSummary& metric : report.metrics) {
    for (const double value : {metric.min, metric.mean, metric.max, metric.stddev, metric.acceptable_fraction}) {
      hash.add(value);
    }
  }
}

std::uint64_t hash_of(const properties::RandomMesh& mesh) {
  Hash hash;
  add_quality(hash, mesh);
  for (std::uint64_t index = 0; index < properties::combinations; ++index) {
    trismooth::SmoothingOptions options = properties::combination(index);
    options.max_sweeps = 20;
    if (options.method == properties::Method::mean_ratio) {
      test_meshes::Random random = properties::draws_for(mesh);
      options.mean_ratio = properties::any_mean_ratio(random);
    }
    const properties::Run run = properties::run(mesh, options);
    for (const double coordinate : run.xy) {
      hash.add(coordinate);
    }
    for (const trismooth::SweepRecord& sweep : run.result.history) {
      hash.add(sweep.max_relative_move);
    }
    add_quality(hash, properties::at_points(mesh, run.xy));
  }
  return hash.value();
}

}  // namespace

int main() try {
#ifdef TRISMOOTH_NEEDS_AVX2
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::puts("skipped: this processor has no AVX2");
    return 77;  // of a test that cannot run here
  }
#endif
  constexpr std::uint64_t meshes = 400;
  for (std::uint64_t seed = 0; seed < meshes; ++seed) {
    fmt::print("{} {:016x}\n", seed, hash_of(random_meshes::random_mesh(seed)));
  }
  return 0;
} catch (const std::exception& error) {
  std::fputs(error.what(), stderr);
  return 1;
}
