// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/splitmix64.h"
#include "trismooth/smoothing/smooth.h"

#include "support/random_meshes.h"
#include "support/same_bits.h"

/// Ways to smooth a random mesh, and what comes of them.
namespace properties {

using random_meshes::RandomMesh;
using trismooth::Form;
using trismooth::Method;
using trismooth::Point2;
using trismooth::Precision;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
using trismooth::StopReason;
using trismooth::Storage;

inline constexpr auto all_methods = trismooth::values_of<Method>();
/// Of methods, two forms and two precisions.
inline constexpr std::uint64_t combinations = 4 * all_methods.size();
/// Method, form and precision number `index`.
inline SmoothingOptions combination(std::uint64_t index) {
  SmoothingOptions options;
  options.method = all_methods[index % all_methods.size()];
  options.form = static_cast<Form>(index / all_methods.size() % 2);
  options.precision = static_cast<Precision>(index / (2 * all_methods.size()) % 2);
  options.threads = 1;
  options.layers = trismooth::Layers::smooth;  // what holds vertices is looked at as the connectivity says
  return options;
}

inline std::string text_of(const SmoothingOptions& options) {
  const std::string text = fmt::format("{}, form {}, {}, {} sweeps, tolerance {}{}", to_string(options.method),
                                       to_string(options.form), to_string(options.precision), options.max_sweeps,
                                       options.tolerance, options.untangles() ? ", untangled" : "");
  const trismooth::MeanRatioOptions& mean_ratio = options.mean_ratio;
  return options.method == Method::mean_ratio
             ? fmt::format("{}, size weight {}, power {}, target {}{}", text, mean_ratio.size_weight, mean_ratio.power,
                           to_string(mean_ratio.target), mean_ratio.steady ? ", steady" : "")
             : text;
}

/// What a property draws for a mesh: the same for the same seed.
inline test_meshes::Random draws_for(const RandomMesh& mesh) {
  return test_meshes::Random(trismooth::splitmix64(mesh.seed));
}

/// What steers the mean-ratio method: often the defaults.
inline trismooth::MeanRatioOptions any_mean_ratio(test_meshes::Random& random) {
  if (random.below(2) == 0) {
    return {};
  }
  return {random.below(3) * random.between(0, 2), random.below(9), static_cast<trismooth::TargetShape>(random.below(2)),
          random.below(3) == 0};
}

/// How vertices slide: in any way.
inline trismooth::Sliding any_sliding(test_meshes::Random& random) {
  using trismooth::Slide;
  using trismooth::SlideCurve;
  trismooth::Sliding slide;
  slide.along = random.below(3) == 0 ? Slide::straight : Slide::curves;
  slide.corner_angle = std::array{30.0, 30.0, 100.0, 180.0, 5.0}[random.below(5)];
  slide.deviation = std::array{1e-3, 1e-2, 0.1, 0.0}[random.below(4)];
  slide.curve = random.below(3) == 0 ? SlideCurve::spline : SlideCurve::polyline;
  return slide;
}

/// Calls `check(options, random)` with `count` of the combinations, in turn from one seed to the next, with sweep
/// limit, tolerance, untangling and what steers the mean-ratio method drawn at random, until it answers something;
/// answers that, and the options.
template <class Check>
std::string for_some_options(const RandomMesh& mesh, std::uint64_t count, const Check& check) {
  test_meshes::Random random = draws_for(mesh);
  for (std::uint64_t i = 0; i < count; ++i) {
    SmoothingOptions options = combination(mesh.seed * count + i);
    options.max_sweeps = random.below(6) == 0 ? 100 : 1 + random.below(12);
    options.tolerance = random.below(3) == 0 ? 1e-2 : 0;
    if (options.method == Method::mean_ratio) {
      options.mean_ratio = any_mean_ratio(random);
    }
    options.untangle = static_cast<trismooth::Untangle>(random.below(3));
    const std::string wrong = check(options, random);
    if (!wrong.empty()) {
      return fmt::format("{} ({})", wrong, text_of(options));
    }
  }
  return {};
}

struct Run {
  std::vector<double> xy;
  SmoothingResult result;
};

inline Run run(const RandomMesh& mesh, const SmoothingOptions& options, Storage storage = Storage::float64) {
  Run run{mesh.mesh.xy(), {}};
  run.result = trismooth::plan(mesh.mesh.vertex_count(), mesh.mesh.indices(), mesh.constraints(), options)
                   .smooth(run.xy, storage);
  return run;
}

/// The first difference of two lists of coordinates; empty where there is none.
inline std::string difference(std::span<const double> found, std::span<const double> expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!same_bits(found[i], expected[i])) {
      return fmt::format("vertex {} is at {} = {} instead of {}", i / 2, i % 2 == 0 ? "x" : "y", found[i], expected[i]);
    }
  }
  return {};
}

/// The first difference of two runs in all that does not depend on who ran.
std::string difference(const Run& found, const Run& expected);

/// The same, but zeros may have another sign.
std::string difference_in_value(Run found, const Run& expected);

inline std::vector<Point2<double>> points_of(std::span<const double> xy) {
  std::vector<Point2<double>> points;
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    points.push_back({xy[i], xy[i + 1]});
  }
  return points;
}

inline RandomMesh at_points(RandomMesh mesh, std::span<const double> xy) {
  mesh.mesh.points = points_of(xy);
  return mesh;
}

/// Whether all numbers are zeros or in a range in which differences have all their digits as well, and sums are finite.
inline bool keeps_digits(std::span<const double> xy) {
  return std::ranges::all_of(xy,
                             [](double x) { return x == 0 || (std::abs(x) >= 0x1p-960 && std::abs(x) <= 0x1p1022); });
}

/// Whether a file of float32 could hold the mesh.
inline bool fits_float32(const RandomMesh& mesh) {
  return std::ranges::all_of(mesh.mesh.xy(), [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); });
}

}  // namespace properties
