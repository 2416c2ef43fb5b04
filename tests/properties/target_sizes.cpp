// SPDX-License-Identifier: BSD-3-Clause
// With sizes asked for: the same bits from every number of threads, plan, evaluation and order of triangles, scaled
// with the mesh by powers of two or not; and nothing that is valid gets invalid.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;

namespace {

/// Options of the method with sizes that `lengths` is filled with, for any mesh.
SmoothingOptions any_sizes(const RandomMesh& mesh, std::vector<double>& lengths, test_meshes::Random& random) {
  const double range = random.below(3) == 0 ? 20 : 1;
  lengths.clear();
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    lengths.push_back(std::exp2(random.between(-range, range)));
  }
  SmoothingOptions options = combination(static_cast<std::uint64_t>(random.below(combinations)));
  options.method = Method::mean_ratio;
  options.max_sweeps = 1 + random.below(30);
  options.mean_ratio = any_mean_ratio(random);
  options.mean_ratio.target_lengths = lengths;
  if (random.below(3) == 0) {
    options.untangle = trismooth::Untangle::on;
  }
  return options;
}

bool keeps_all_digits(std::span<const double> xy) {
  return std::ranges::all_of(xy, [](double x) { return x == 0 || (std::abs(x) > 1e-200 && std::abs(x) < 1e200); });
}

}  // namespace

TEST_CASE("with sizes asked for nothing depends on threads, plans, evaluation and the order of triangles") {
  for_random_meshes(1000, [](const RandomMesh& mesh) -> std::string {
    test_meshes::Random random = draws_for(mesh);
    std::vector<double> lengths;
    SmoothingOptions options = any_sizes(mesh, lengths, random);
    const Run expected = run(mesh, options);
    options.threads = 3;
    if (const std::string wrong = difference(run(mesh, options), expected); !wrong.empty()) {
      return "threads: " + wrong;
    }
    options.evaluation = trismooth::Evaluation::all;
    if (Run all = run(mesh, options); all.xy != expected.xy) {
      return "evaluating all: " + difference(all.xy, expected.xy);
    }
    options.evaluation = trismooth::Evaluation::changed;
    RandomMesh turned = mesh;
    for (auto& t : turned.mesh.triangles) {
      std::rotate(t.begin(), t.begin() + random.below(3), t.end());
    }
    if (const std::string wrong = difference(run(turned, options), expected); !wrong.empty()) {
      return "other corners first: " + wrong;
    }
    const auto indices = mesh.mesh.indices();
    auto plan = trismooth::plan(mesh.mesh.vertex_count(), indices, mesh.constraints(), options);
    for (int times = 0; times < 2; ++times) {
      Run planned{mesh.mesh.xy(), {}};
      planned.result = plan.smooth(planned.xy);
      if (const std::string wrong = difference(planned, expected); !wrong.empty()) {
        return "a plan: " + wrong;
      }
    }
    return {};
  });
}

TEST_CASE("a mesh and the sizes asked for, scaled by powers of two, give the same bits, scaled") {
  for_random_meshes(1000, [](const RandomMesh& mesh) -> std::string {
    test_meshes::Random random = draws_for(mesh);
    std::vector<double> lengths;
    const SmoothingOptions options = any_sizes(mesh, lengths, random);
    const Run expected = run(mesh, options);
    if (!keeps_all_digits(mesh.mesh.xy()) || !keeps_all_digits(expected.xy)) {
      return {};
    }
    const int power = random.below(200) - 100;
    const int power_of_sizes = random.below(2) == 0 ? power : random.below(400) - 200;
    RandomMesh larger = mesh;
    for (auto& p : larger.mesh.points) {
      p = {std::ldexp(p.x, power), std::ldexp(p.y, power)};
    }
    for (double& length : lengths) {
      length = std::ldexp(length, power_of_sizes);
    }
    Run found = run(larger, options);
    for (double& x : found.xy) {
      x = std::ldexp(x, -power);
    }
    const std::string wrong = difference(found.xy, expected.xy);
    return wrong.empty() ? wrong : fmt::format("scaled by 2^{}, sizes by 2^{}: {}", power, power_of_sizes, wrong);
  });
}

TEST_CASE("for sizes asked for no valid element gets invalid, what is held stays, and the guard keeps true counts") {
  for_random_meshes(1000, [](const RandomMesh& mesh) -> std::string {
    test_meshes::Random random = draws_for(mesh);
    std::vector<double> lengths;
    const SmoothingOptions options = any_sizes(mesh, lengths, random);
    const Connectivity connectivity = connectivity_of(mesh);
    const Run found = run(mesh, options);
    // All that the contract asks for without the guard.
    if (const std::string wrong = breach(mesh, connectivity, found, false);
        !wrong.empty() && found.result.reverted.empty()) {
      return wrong;
    }
    const std::vector<Point2<double>> before = mesh.mesh.points;
    const std::vector<Point2<double>> after = points_of(found.xy);
    if (connectivity.is_tied || found.result.untangling.value_or(trismooth::UntanglingResult{}).turned_components > 0) {
      return {};
    }
    for (const auto& [a, b, c] : connectivity.elements) {
      if (trismooth::shape_quotient(before[a], before[b], before[c]) > 1e-12 &&
          !(trismooth::shape_quotient(after[a], after[b], after[c]) > 0)) {
        return fmt::format("element {} {} {} was valid and is not", a, b, c);
      }
    }
    return {};
  });
}
