// SPDX-License-Identifier: BSD-3-Clause
// Sizes of the caller's own: how they are read, what the mean-ratio method aims at then, and what it makes of a mesh.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/guard/never_worse.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"
#include "trismooth/smoothing/sweeps/relative_sizes.h"

#include "catch.h"
#include "support/packed_mesh.h"
#include "support/same_bits.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"

namespace target_sizes_test {

using test_meshes::Mesh;
using trismooth::Form;
using trismooth::inverse_sizes;
using trismooth::Method;
using trismooth::Point2;
using trismooth::Precision;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Doubles = std::vector<double>;

/// The options view the lengths.
SmoothingOptions aiming_at(const Doubles& lengths, double weight = 1) {
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.threads = 2;
  options.mean_ratio.size_weight = weight;
  options.mean_ratio.target_lengths = lengths;
  return options;
}

template <class Field>
Doubles lengths_by(const Mesh& mesh, const Field& field) {
  Doubles lengths;
  for (const auto p : mesh.points) {
    lengths.push_back(field(p));
  }
  return lengths;
}

/// Short on a circle in the middle of the mesh, and longer the farther away.
Doubles ring_of_short_ones(const Mesh& mesh) {
  const auto frame = trismooth::local_frame(mesh.points);
  return lengths_by(mesh, [&](Point2<double> p) {
    const Point2<double> local = frame.enter(p);
    const Point2<double> middle = frame.enter(mesh.points[mesh.points.size() / 2]);
    return 1 + 6 * std::abs(std::hypot(local.x - middle.x, local.y - middle.y) - 0.25);
  });
}

struct Smoothed {
  Doubles xy;
  SmoothingResult result;
};

Smoothed smoothed(const Mesh& mesh, const SmoothingOptions& options) {
  Smoothed run{mesh.xy(), {}};
  run.result = trismooth::smooth(trismooth::xy_points(run.xy), mesh.indices(), options);
  return run;
}

std::vector<bool> is_free(const Mesh& mesh) {
  trismooth::Workers workers(1);
  const auto topology = trismooth::connect_triangles(mesh.vertex_count(), mesh.triangles, workers);
  std::vector<bool> flags;
  for (const std::uint8_t hold : topology.hold) {
    flags.push_back(hold == 0);
  }
  return flags;
}

/// Root mean square of ln(A / A*), where A* is half of h^2 up to the factor that makes it least, and the smallest shape
/// of the triangles with a free vertex.
struct Fit {
  double rms = 0;
  double smallest_shape = 1;
};
Fit fit_of(const Mesh& mesh, const Doubles& xy, const Doubles& lengths) {
  const std::vector<bool> free = is_free(mesh);
  Doubles logs;
  Fit fit;
  for (const auto& t : mesh.triangles) {
    if (!free[t[0]] && !free[t[1]] && !free[t[2]]) {
      continue;
    }
    std::array<Point2<double>, 3> p;
    double inverse = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = static_cast<std::size_t>(t[i]);
      p[i] = {xy[2 * v], xy[2 * v + 1]};
      inverse += 1 / (lengths[v] * lengths[v]);
    }
    logs.push_back(std::log(cross(p[1] - p[0], p[2] - p[0]) * inverse));
    fit.smallest_shape = std::min(fit.smallest_shape, trismooth::shape(p[0], p[1], p[2]));
  }
  const double mean = std::accumulate(logs.begin(), logs.end(), 0.0) / static_cast<double>(logs.size());
  double squares = 0;
  for (const double log : logs) {
    squares += (log - mean) * (log - mean);
  }
  fit.rms = std::sqrt(squares / static_cast<double>(logs.size()));
  return fit;
}

TEST_CASE("sizes are relative to the power of two below the largest length, and those of no triangle do not count") {
  const std::vector<std::uint8_t> fixed{0, trismooth::hold::boundary, trismooth::hold::isolated, 0,
                                        trismooth::hold::isolated | trismooth::hold::other_cell};
  const Doubles lengths{3, 6, nan, 0.5, -1};
  CHECK(inverse_sizes(aiming_at(lengths), fixed) == Doubles{1 / 0.5625, 1 / 2.25, 1, 64, 1});
  for (const int power : {-1060, -300, 1, 1000}) {
    Doubles scaled;
    for (const double length : {3.0, 6.0, 0.0, 0.5, infinity}) {
      scaled.push_back(std::ldexp(length, power));
    }
    CHECK(inverse_sizes(aiming_at(scaled), fixed) == inverse_sizes(aiming_at(lengths), fixed));
  }
  const Doubles far{1, 1e-30, 0, 0x1p-20, 0};
  CHECK(inverse_sizes(aiming_at(far), fixed) == Doubles{1, 0x1p40, 1, 0x1p40, 1});
  CHECK(inverse_sizes(aiming_at(Doubles(5, 1e300)), fixed).size() == 5);
  CHECK(inverse_sizes(aiming_at({}), fixed).empty());
  SmoothingOptions other = aiming_at(lengths);
  other.method = Method::smart;
  CHECK(inverse_sizes(other, fixed).empty());
}

TEST_CASE("lengths that are none are refused by name, and the mesh is untouched") {
  const Mesh mesh = test_meshes::jittered_grid(6, 6, 0.2, 1);
  Doubles lengths(mesh.points.size(), 1);
  const SmoothingOptions options = aiming_at(lengths);
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    lengths[17] = bad;
    lengths[23] = -1;
    Doubles xy = mesh.xy();
    const std::string message = message_of<std::invalid_argument>(
        [&] { trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), options); });
    CHECK(message.find("target_lengths: that of vertex 17 is not a positive number") != std::string::npos);
    CHECK(xy == mesh.xy());
  }
  const Doubles few(mesh.points.size() - 1, 1);
  for (const Method method : trismooth::values_of<Method>()) {
    SmoothingOptions with_few = aiming_at(few);
    with_few.method = method;
    const std::string message = message_of<std::invalid_argument>([&] { smoothed(mesh, with_few); });
    CHECK(message.find("target_lengths has 35 entries, expected 36 or none") != std::string::npos);
  }
}

TEST_CASE("lengths of float are those of double, and are read in every call of a plan") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.3, 2);
  std::vector<float> single(mesh.points.size());
  Doubles lengths(mesh.points.size());
  SmoothingOptions of_single = aiming_at(lengths);
  of_single.mean_ratio.target_lengths = single;
  auto planned = trismooth::plan(mesh.vertex_count(), mesh.indices(), of_single);
  for (const double growth : {1.0, 3.0}) {
    for (std::size_t v = 0; v < single.size(); ++v) {
      single[v] = static_cast<float>(0.1 + growth * mesh.points[v].x * mesh.points[v].x);
      lengths[v] = static_cast<double>(single[v]);
    }
    Doubles xy = mesh.xy();
    planned.smooth(xy);
    CHECK(xy == smoothed(mesh, aiming_at(lengths)).xy);
  }
}

TEST_CASE("other methods take no notice of lengths") {
  const Mesh mesh = test_meshes::jittered_grid(8, 8, 0.3, 1);
  for (const Method method : {Method::smart, Method::laplacian, Method::weighted}) {
    const Doubles bad(mesh.points.size(), -1);
    SmoothingOptions with = aiming_at(bad);
    with.method = method;
    SmoothingOptions without;
    without.method = method;
    CHECK(smoothed(mesh, with).xy == smoothed(mesh, without).xy);
  }
}

/// What is aimed at, by the caller's numbers: twice the areas, and the least shape quotient.
struct Aims {
  Doubles areas;
  double least_quotient = 0;
};
template <class T>
Aims aims_of(const Mesh& mesh, const Doubles& lengths, int threads) {
  test_meshes::PackedMesh<T> packed(mesh, Form::in_place, threads);
  const SmoothingOptions options = aiming_at(lengths);
  const auto targets = packed.targets(options.mean_ratio, inverse_sizes(options, packed.found.fixed));
  Aims aims{Doubles(lengths.size()), static_cast<double>(targets.view().scales->least_quotient)};
  for (std::size_t v = 0; v < lengths.size(); ++v) {
    aims.areas[packed.rings.input_index[v]] = 1 / static_cast<double>(targets.view().inverse_areas[v]);
  }
  return aims;
}

TEST_CASE("areas aimed at go with the squares of lengths, and are as much together as there is") {
  for (const double range : {1.0, 30.0, 3e4}) {
    CAPTURE(range);
    const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(60, 60, 0.3, 3), 4);
    const auto frame = trismooth::local_frame(mesh.points);
    const Doubles lengths =
        lengths_by(mesh, [&](Point2<double> p) { return 0.1 + range * std::pow(frame.enter(p).x, 8); });
    const Aims aims = aims_of<double>(mesh, lengths, 2);
    const std::vector<bool> free = is_free(mesh);
    long double there = 0;
    long double asked = 0;
    double worst = 1;
    for (const auto& t : mesh.triangles) {
      const auto at = [&](std::size_t i) { return frame.enter(mesh.points[static_cast<std::size_t>(t[i])]); };
      const double area = cross(at(1) - at(0), at(2) - at(0));
      const int corners = free[t[0]] + free[t[1]] + free[t[2]];
      there += static_cast<long double>(corners) * area;
      asked +=
          static_cast<long double>(corners) * 3 / (1 / aims.areas[t[0]] + 1 / aims.areas[t[1]] + 1 / aims.areas[t[2]]);
      if (corners > 0) {
        worst = std::min(worst, trismooth::shape(at(0), at(1), at(2)));
      }
    }
    CHECK(static_cast<double>(asked) == Approx(static_cast<double>(there)).epsilon(1e-9));
    for (std::size_t v = 1; v < lengths.size(); ++v) {
      REQUIRE(aims.areas[v] / aims.areas[0] ==
              Approx(lengths[v] * lengths[v] / (lengths[0] * lengths[0])).epsilon(1e-12));
    }
    // A little above the worst, so that what gets near it is not below it when it is written.
    CHECK(aims.least_quotient * trismooth::shape_constant > worst);
    CHECK(aims.least_quotient * trismooth::shape_constant < 1.002 * worst);
  }
}

TEMPLATE_TEST_CASE("what is aimed at depends on no number of threads and on no numbering of the vertices", "", float,
                   double) {
  const Mesh mesh = test_meshes::jittered_grid(70, 70, 0.35, 9);
  const Doubles lengths = ring_of_short_ones(mesh);
  const Aims expected = aims_of<TestType>(mesh, lengths, 1);
  for (const int threads : {2, 5}) {
    const Aims found = aims_of<TestType>(mesh, lengths, threads);
    CHECK(found.areas == expected.areas);
    CHECK(found.least_quotient == expected.least_quotient);
  }
  std::vector<std::int32_t> number(mesh.points.size());
  std::iota(number.begin(), number.end(), 0);
  test_meshes::Random random(6);
  random.shuffle(number);
  Mesh other = mesh;
  Doubles other_lengths(lengths.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    other.points[number[v]] = mesh.points[v];
    other_lengths[number[v]] = lengths[v];
  }
  for (auto& t : other.triangles) {
    t = {number[t[0]], number[t[1]], number[t[2]]};
  }
  const Aims found = aims_of<TestType>(other, other_lengths, 2);
  CHECK(found.least_quotient == expected.least_quotient);
  for (std::size_t v = 0; v < number.size(); ++v) {
    REQUIRE(found.areas[number[v]] == expected.areas[v]);
  }
}

TEST_CASE("sizes get about twice as near to those asked for, no shape gets below the worst, and nothing goes back") {
  const Mesh mesh = test_meshes::jittered_grid(50, 50, 0.25, 2);
  const Doubles ring = ring_of_short_ones(mesh);
  const double rms_before = fit_of(mesh, mesh.xy(), ring).rms;
  for (const Form form : {Form::swap, Form::in_place}) {
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
      SmoothingOptions options = aiming_at(ring, 5);
      options.form = form;
      options.precision = precision;
      const Smoothed run = smoothed(mesh, options);
      const Fit after = fit_of(mesh, run.xy, ring);
      CAPTURE(form, precision, rms_before, after.rms);
      CHECK((form == Form::in_place ? 2 : 1.6) * after.rms < rms_before);
      CHECK(after.smallest_shape >= fit_of(mesh, mesh.xy(), ring).smallest_shape);
      CHECK(run.result.reverted_vertices == 0);
      // By itself the method keeps what sizes there are.
      options.mean_ratio.target_lengths = {};
      CHECK(fit_of(mesh, smoothed(mesh, options).xy, ring).rms > 1.5 * after.rms);
    }
  }
}

TEST_CASE("a mesh that is graded by accident evens out where one size is asked for") {
  Mesh mesh = test_meshes::jittered_grid(40, 40, 0, 5);
  for (auto& p : mesh.points) {
    p.x += 0.14 * std::sin(2 * std::numbers::pi * p.x) * std::sin(std::numbers::pi * p.y);  // the boundary stays
  }
  const Doubles one(mesh.points.size(), 7);
  SmoothingOptions options = aiming_at(one);
  options.layers = trismooth::Layers::smooth;  // its triangles are flat as those of layers
  const Smoothed run = smoothed(mesh, options);
  CHECK(2 * fit_of(mesh, run.xy, one).rms < fit_of(mesh, mesh.xy(), one).rms);
}

TEST_CASE("a good mesh, too, gets nearer to sizes asked for, as far as its worst shape allows") {
  Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 7);
  SmoothingOptions first;
  first.method = Method::mean_ratio;
  const Doubles good = smoothed(mesh, first).xy;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    mesh.points[v] = {good[2 * v], good[2 * v + 1]};
  }
  const Doubles ring = ring_of_short_ones(mesh);
  const Fit before = fit_of(mesh, mesh.xy(), ring);
  REQUIRE(before.smallest_shape > 0.5);
  const Smoothed run = smoothed(mesh, aiming_at(ring));
  const Fit after = fit_of(mesh, run.xy, ring);
  CHECK(after.rms < 0.85 * before.rms);
  CHECK(after.smallest_shape >= before.smallest_shape);
  CHECK(run.result.reverted_vertices == 0);
}

TEST_CASE("a mesh beside a triangle that is far larger aims at its sizes all the same") {
  const Mesh alone = test_meshes::jittered_grid(20, 20, 0.3, 8);
  const Doubles lengths = ring_of_short_ones(alone);
  const double before = fit_of(alone, alone.xy(), lengths).rms;
  const double expected = fit_of(alone, smoothed(alone, aiming_at(lengths)).xy, lengths).rms;
  REQUIRE(expected < 0.95 * before);
  for (const int exponent : {10, 20, 27, 34}) {
    CAPTURE(exponent, before);
    Mesh mesh = alone;
    const double far = std::ldexp(1.0, exponent);
    const std::int32_t first = mesh.vertex_count();
    mesh.points.insert(mesh.points.end(), {{-far, -far}, {-2 * far, -far}, {-far, -2 * far}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    Doubles all = lengths;
    all.insert(all.end(), 3, 1);
    Doubles xy = smoothed(mesh, aiming_at(all)).xy;
    xy.resize(lengths.size() * 2);
    CHECK(std::abs(fit_of(alone, xy, lengths).rms - expected) < 0.01 * expected);
  }
}

TEST_CASE("a plan reads the lengths anew in every call") {
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.3, 8);
  const Doubles ring = ring_of_short_ones(mesh);
  const Doubles one(ring.size(), 1);
  Doubles lengths = one;
  const auto indices = mesh.indices();
  auto plan = trismooth::plan(mesh.vertex_count(), indices, aiming_at(lengths));
  for (const Doubles* now : {&one, &ring, &one}) {
    lengths = *now;
    Doubles xy = mesh.xy();
    plan.smooth(xy);
    CHECK(xy == smoothed(mesh, aiming_at(*now)).xy);
  }
  CHECK_FALSE(smoothed(mesh, aiming_at(ring)).xy == smoothed(mesh, aiming_at(one)).xy);
}

}  // namespace target_sizes_test
