// SPDX-License-Identifier: BSD-3-Clause
// The result is a function of mesh and options alone: not of the run, the plan, the evaluation, the threads, nor of the
// order and the corners in which triangles are listed.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;
using trismooth::Evaluation;
using trismooth::Triangle;

namespace {

RandomMesh with_other_corners_first(RandomMesh mesh, test_meshes::Random& random) {
  for (Triangle& t : mesh.mesh.triangles) {
    std::rotate(t.begin(), t.begin() + random.below(3), t.end());
  }
  return mesh;
}

RandomMesh with_triangles_reversed(RandomMesh mesh, test_meshes::Random& random) {
  for (Triangle& t : mesh.mesh.triangles) {
    if (random.below(2) == 0) {
      std::swap(t[0], t[1]);
    }
  }
  return mesh;
}

RandomMesh with_triangles_shuffled(const RandomMesh& mesh, test_meshes::Random& random) {
  std::vector<std::size_t> order(mesh.mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  RandomMesh shuffled = mesh;
  for (std::size_t t = 0; t < order.size(); ++t) {
    shuffled.mesh.triangles[t] = mesh.mesh.triangles[order[t]];
    if (!mesh.regions.empty()) {
      shuffled.regions[t] = mesh.regions[order[t]];
    }
  }
  return shuffled;
}

std::string told(const std::string& what, const std::string& difference) {
  return difference.empty() ? difference : what + ": " + difference;
}

/// Many meshes as one, side by side, without what is held of them.
RandomMesh union_of(std::uint64_t first_seed, std::int32_t vertices) {
  RandomMesh all;
  for (std::uint64_t seed = first_seed; all.mesh.vertex_count() < vertices; ++seed) {
    const RandomMesh next = random_meshes::random_mesh(seed);
    const bool is_usual = std::ranges::all_of(next.mesh.xy(), [](double x) { return std::abs(x) < 10; });
    if (is_usual) {
      const auto place = static_cast<double>(seed - first_seed);
      all.mesh = test_meshes::together(std::move(all.mesh), next.mesh, {place, 0});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("runs repeated, plans used again, flat arrays, and evaluating all give the same bits") {
  for_random_meshes(2000, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.record_min_shape = random.below(2) == 0;
      const Run expected = run(mesh, options);
      const auto indices = mesh.mesh.indices();
      auto plan = trismooth::plan(mesh.mesh.vertex_count(), indices, mesh.constraints(), options);
      for (int times = 0; times < 2; ++times) {
        Run planned{mesh.mesh.xy(), {}};
        planned.result = plan.smooth(planned.xy);
        if (const std::string wrong = difference(planned, expected); !wrong.empty()) {
          return told("a plan", wrong);
        }
        // What it has seen in between does not matter, mirrored as it may be.
        std::vector<double> other = expected.xy;
        for (std::size_t i = 0; i < other.size(); i += 2) {
          other[i] = -other[i];
        }
        plan.smooth(other);
      }
      Run flat{mesh.mesh.xy(), {}};
      flat.result = trismooth::smooth(trismooth::xy_points(flat.xy), indices, mesh.constraints(), options);
      if (const std::string wrong = difference(flat, expected); !wrong.empty()) {
        return told("flat arrays", wrong);
      }
      options.evaluation = Evaluation::all;
      return told("evaluating all", difference(run(mesh, options), expected));
    });
  });
}

TEST_CASE("the order of triangles, their corners and their directions do not matter") {
  std::int64_t tied = 0;
  std::int64_t looked_at = 0;
  for_random_meshes(2000, [&](const RandomMesh& mesh) {
    // Of as many inverted triangles as others the order decides which they are.
    const bool is_tied = connectivity_of(mesh).is_tied;
    tied += is_tied ? 1 : 0;
    ++looked_at;
    return for_some_options(mesh, 2, [&](const SmoothingOptions& options, test_meshes::Random& random) -> std::string {
      const Run expected = run(mesh, options);
      const RandomMesh turned = with_other_corners_first(mesh, random);
      if (const std::string wrong = difference(run(turned, options), expected); !wrong.empty()) {
        return told("other corners first", wrong);
      }
      if (is_tied) {
        return {};
      }
      const RandomMesh reversed = with_triangles_reversed(mesh, random);
      if (const std::string wrong = difference(run(reversed, options), expected); !wrong.empty()) {
        return told("triangles reversed", wrong);
      }
      return told("triangles shuffled", difference(run(with_triangles_shuffled(turned, random), options), expected));
    });
  });
  CHECK(2 * tied < looked_at + 2);
}

TEST_CASE("the number of threads does not matter") {
  // Loops are shared out from some thousand vertices on.
  const auto rounds = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(meshes_of(combinations)));
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const RandomMesh mesh = union_of(1000 * round, round % 3 == 0 ? 20000 : 6000);
    for (std::uint64_t index = round; index < round + 3; ++index) {
      SmoothingOptions options = combination(5 * index);
      options.max_sweeps = 8;
      options.untangle = trismooth::Untangle::on;
      const Run expected = run(mesh, options);
      CHECK(expected.result.moved_vertices > 500);
      for (const int threads : {2, 3, 7, 16}) {
        options.threads = threads;
        CAPTURE(round, threads, text_of(options));
        REQUIRE(difference(run(mesh, options), expected).empty());
      }
    }
  }
}
