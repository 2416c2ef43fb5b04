// SPDX-License-Identifier: BSD-3-Clause
// What a transformation of the mesh that loses no digit does to the result.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/base/local_frame.h"

#include "catch.h"
#include "properties/contract.h"
#include "properties/decision_margin.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;

namespace {

std::vector<double> scaled(std::vector<double> xy, int power) {
  std::ranges::transform(xy, xy.begin(), [power](double x) { return std::ldexp(x, power); });
  return xy;
}

/// The mesh in its local frame, on multiples of 2^-20.
RandomMesh on_lattice(RandomMesh mesh) {
  const trismooth::LocalFrame frame = trismooth::local_frame(mesh.mesh.points);
  for (auto& p : mesh.mesh.points) {
    p = frame.enter(p);
    p = {std::round(p.x * 0x1p20) * 0x1p-20, std::round(p.y * 0x1p20) * 0x1p-20};
  }
  return mesh;
}

RandomMesh shifted(RandomMesh mesh, double x, double y) {
  for (auto& p : mesh.mesh.points) {
    p = {p.x + x, p.y + y};
  }
  return mesh;
}

}  // namespace

TEST_CASE("a mesh scaled by a power of two is smoothed to the same bits, scaled") {
  std::int64_t left_out = 0;
  std::int64_t looked_at = 0;
  for_random_meshes(3000, [&](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      const Run expected = run(mesh, options);
      for (const int power : {-300, 300, random.below(600) - 300}) {
        ++looked_at;
        const std::vector<double> larger = scaled(mesh.mesh.xy(), power);
        if (!keeps_digits(mesh.mesh.xy()) || !keeps_digits(larger) || !keeps_digits(expected.xy) ||
            !keeps_digits(scaled(expected.xy, power))) {
          ++left_out;
          continue;
        }
        Run found = run(at_points(mesh, larger), options);
        found.xy = scaled(found.xy, -power);
        for (auto& [vertex, position] : found.result.reverted) {
          position = {std::ldexp(position.x, -power), std::ldexp(position.y, -power)};
        }
        if (const std::string wrong = difference(found, expected); !wrong.empty()) {
          return fmt::format("scaled by 2^{}: {}", power, wrong);
        }
      }
      return {};
    });
  });
  CHECK(5 * left_out < looked_at + 5);
}

TEST_CASE("a mesh turned by a right angle is smoothed to the same coordinates, turned") {
  // Products change places and signs, and no sum changes its order: all that may differ is the sign of a zero.
  for_random_meshes(3000, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 3, [&](const SmoothingOptions& options, test_meshes::Random& random) {
      const Storage storage = fits_float32(mesh) && random.below(3) == 0 ? Storage::float32 : Storage::float64;
      const Run expected = run(mesh, options, storage);
      RandomMesh turned = mesh;
      for (auto& p : turned.mesh.points) {
        p = {-p.y, p.x};
      }
      Run found = run(turned, options, storage);
      for (std::size_t i = 0; i < found.xy.size(); i += 2) {
        found.xy[i] = -found.xy[i];
        std::swap(found.xy[i], found.xy[i + 1]);
      }
      for (auto& [vertex, position] : found.result.reverted) {
        position = {position.y, -position.x};
      }
      return difference_in_value(found, expected);
    });
  });
}

TEST_CASE("a mesh shifted to where coordinates have as many digits is smoothed to the same bits, shifted") {
  // Both are so far from the origin that their frames are translated, by centres that differ by the shift; and between
  // 16 and 32 coordinates are equally far apart, so that nothing is rounded otherwise on the way back.
  for_random_meshes(3000, [](const RandomMesh& any) {
    const RandomMesh mesh = shifted(on_lattice(any), 20, -20);
    return for_some_options(mesh, 2, [&](const SmoothingOptions& options, test_meshes::Random& random) {
      const Storage storage = random.below(3) == 0 ? Storage::float32 : Storage::float64;
      const Run expected = run(mesh, options, storage);
      Run found = run(shifted(mesh, 4, -8), options, storage);
      for (std::size_t i = 0; i < found.xy.size(); i += 2) {
        found.xy[i] -= 4;
        found.xy[i + 1] += 8;
      }
      for (auto& [vertex, position] : found.result.reverted) {
        position = {position.x - 4, position.y + 8};
      }
      return difference(found, expected);
    });
  });
}

TEST_CASE("a mesh shifted by any exact translation is smoothed to the same coordinates, shifted, to rounding") {
  // Frames are translated only where the mesh is far from the origin, so arithmetic is rounded otherwise here and
  // there. Where no decision hangs on that, coordinates agree to 1e-12 of the extent. Meshes that are full of ties are
  // not drawn.
  std::int64_t left_out = 0;
  std::int64_t looked_at = 0;
  for_random_meshes(2000, [&](const RandomMesh& any) -> std::string {
    RandomMesh mesh = on_lattice(any);
    test_meshes::Random jiggle = draws_for(any);
    for (auto& p : mesh.mesh.points) {
      p.x += jiggle.below(1 << 16) * 0x1p-20;
      p.y += jiggle.below(1 << 16) * 0x1p-20;
    }
    const Connectivity connectivity = connectivity_of(mesh);
    if (connectivity.is_tied || std::ranges::all_of(connectivity.fixed, std::identity{})) {
      return {};
    }
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.precision = Precision::double_precision;
      options.untangle = trismooth::Untangle::off;  // it magnifies rounding, too
      options.max_sweeps = 1 + random.below(3);
      options.tolerance = 0;
      options.guard = random.below(2) == 0;
      if (options.method == Method::mean_ratio) {
        return {};  // Newton's steps magnify rounding, the more the flatter triangles are
      }
      ++looked_at;
      if (decision_margin(mesh, connectivity, options) < 1e-12) {
        ++left_out;
        return {};
      }
      const Run expected = run(mesh, options);
      const double x = random.below(7) - 3;
      const double y = random.below(7) - 3;
      const Run found = run(shifted(mesh, x, y), options);
      for (std::size_t i = 0; i < found.xy.size(); ++i) {
        const double error = std::abs(found.xy[i] - (i % 2 == 0 ? x : y) - expected.xy[i]);
        if (!(error < 1e-12)) {
          return fmt::format("shifted by {} {}, vertex {} is off by {}", x, y, i / 2, error);
        }
      }
      return {};
    });
  });
  UNSCOPED_INFO(left_out << " of " << looked_at << " left out");
  CHECK(looked_at >= meshes_of(1500));
  CHECK(left_out <= 1 + looked_at / 10);
}
