// SPDX-License-Identifier: BSD-3-Clause
// Smoothing meshes of quadrilaterals, and of these and triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/instruction_set.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/limited_instructions.h"
#include "support/mixed_meshes.h"
#include "support/naive_smoothing.h"
#include "support/refusal.h"
#include "support/same_bits.h"

namespace trismooth::smooth_quadrilaterals_test {

using mixed_meshes::MixedMesh;
using mixed_meshes::shape_by_definition;
using test_support::refusal;
using Numbers = std::vector<double>;

constexpr std::uint64_t random_meshes = 150;

SmoothingOptions with(Method method, Form form = Form::in_place) {
  SmoothingOptions options;
  options.method = method;
  options.form = form;
  options.threads = 1;
  return options;
}

Numbers smoothed(const MixedMesh& mesh, const SmoothingOptions& options, const Constraints& constraints = {}) {
  Numbers xy = mesh.xy();
  smooth(xy_points(xy), mesh.elements, constraints, options);
  return xy;
}

/// What is around a vertex, by a map from each neighbour to the element behind it.
struct NaiveRing {
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> opposites;  ///< -1 in triangles
};

/// Rings of the vertices whose elements go all around them, from the smallest neighbour on.
std::map<std::int32_t, NaiveRing> naive_rings(const MixedMesh& mesh) {
  struct Link {
    std::int32_t opposite;
    std::int32_t previous;
  };
  std::vector<std::map<std::int32_t, Link>> links(mesh.points.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      links[static_cast<std::size_t>(corners[i])][corners[(i + 1) % count]] = {count == 4 ? corners[(i + 2) % 4] : -1,
                                                                               corners[(i + count - 1) % count]};
    }
  }
  std::map<std::int32_t, NaiveRing> rings;
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto& around = links[static_cast<std::size_t>(v)];
    if (around.empty()) {
      continue;
    }
    NaiveRing ring;
    std::int32_t neighbour = around.begin()->first;
    while (ring.neighbours.size() < around.size() && around.contains(neighbour)) {
      ring.neighbours.push_back(neighbour);
      ring.opposites.push_back(around.at(neighbour).opposite);
      neighbour = around.at(neighbour).previous;
    }
    if (ring.neighbours.size() == around.size() && neighbour == around.begin()->first) {
      rings[v] = ring;
    }
  }
  return rings;
}

/// The vertices of each colour, where every vertex of an element counts as a neighbour.
std::vector<std::vector<std::int32_t>> naive_colours(std::size_t vertices,
                                                     const std::map<std::int32_t, NaiveRing>& rings) {
  naive::Rings others(vertices);
  for (const auto& [v, ring] : rings) {
    others[static_cast<std::size_t>(v)] = ring.neighbours;
    std::ranges::copy(ring.opposites, std::back_inserter(others[static_cast<std::size_t>(v)]));
  }
  return naive::colour_classes(others);
}

/// What the smart rule compares of the elements of a vertex: the smallest quality and how many are inverted.
struct Around {
  double smallest = std::numeric_limits<double>::infinity();
  int inverted = 0;
};

/// Sweeps as the contract says them, of the Laplacian methods: to the mean of the neighbours along sides, and with
/// `is_smart` only where the smallest quality of the incident elements grows and no more are inverted.
Numbers naively_smoothed(const MixedMesh& mesh, bool is_smart, Form form, int sweeps) {
  const std::map<std::int32_t, NaiveRing> rings = naive_rings(mesh);
  std::vector<std::vector<std::int32_t>> batches;
  if (form == Form::in_place) {
    batches = naive_colours(mesh.points.size(), rings);
  } else {
    batches.emplace_back();
    for (const auto& [v, ring] : rings) {
      batches.back().push_back(v);
    }
  }
  std::map<std::int32_t, std::vector<std::size_t>> elements;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (const std::int32_t v : mesh.corners(e)) {
      elements[v].push_back(e);
    }
  }
  Numbers xy = mesh.xy();
  const auto look_around = [&](std::int32_t v) {
    Around around;
    for (const std::size_t e : elements[v]) {
      const double shape = shape_by_definition(mesh, e, xy);
      around.smallest = std::min(around.smallest, shape);
      around.inverted += shape < 0 ? 1 : 0;
    }
    return around;
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (const auto& batch : batches) {
      Numbers next = xy;
      for (const std::int32_t v : batch) {
        const auto place = 2 * static_cast<std::size_t>(v);
        const std::array<double, 2> was{xy[place], xy[place + 1]};
        const NaiveRing& ring = rings.at(v);
        std::array<double, 2> mean{0, 0};
        for (const std::int32_t n : ring.neighbours) {
          mean[0] += xy[2 * static_cast<std::size_t>(n)];
          mean[1] += xy[2 * static_cast<std::size_t>(n) + 1];
        }
        const double weight = 1.0 / static_cast<double>(ring.neighbours.size());
        const Around before = look_around(v);
        xy[place] = mean[0] * weight;
        xy[place + 1] = mean[1] * weight;
        const Around after = look_around(v);
        const bool moves = !is_smart || (after.smallest > before.smallest && after.inverted <= before.inverted);
        if (moves) {
          next[place] = xy[place];
          next[place + 1] = xy[place + 1];
        }
        xy[place] = was[0];
        xy[place + 1] = was[1];
      }
      xy = next;
    }
  }
  return xy;
}

TEST_CASE("Laplacian and smart sweeps over quadrilaterals are those of the contract") {
  int moved = 0;
  for (std::uint64_t seed = 0; seed < random_meshes; ++seed) {
    const MixedMesh mesh = mixed_meshes::random_mesh(seed);
    for (const Form form : {Form::in_place, Form::swap}) {
      for (const bool is_smart : {true, false}) {
        CAPTURE(seed, form == Form::swap, is_smart);
        SmoothingOptions options = with(is_smart ? Method::smart : Method::laplacian, form);
        options.guard = false;
        options.layers = Layers::smooth;
        options.max_sweeps = 3;
        const Numbers expected = naively_smoothed(mesh, is_smart, form, 3);
        const Numbers found = smoothed(mesh, options);
        // Sweeps are made in a frame of their own, a power of two wide but moved.
        for (std::size_t i = 0; i < expected.size(); ++i) {
          REQUIRE(std::abs(found[i] - expected[i]) < 1e-12 * 100);
        }
        moved += found == mesh.xy() ? 0 : 1;
      }
    }
  }
  CHECK(moved > 300);
}

TEST_CASE("no two vertices of a quadrilateral move at the same time") {
  for (std::uint64_t seed = 0; seed < random_meshes; ++seed) {
    CAPTURE(seed);
    const MixedMesh mesh = mixed_meshes::random_mesh(seed);
    Workers workers(1 + static_cast<int>(seed % 3));
    const auto topology = connect_triangles(mesh.vertex_count(), std::span<const MixedElement>(mesh.elements), workers);
    const OneRings rings =
        one_rings(topology, std::span<const MixedElement>(mesh.elements), topology.parity, topology.hold, workers);
    const Colouring colouring = colour_free_vertices(rings.view(), workers);
    const std::map<std::int32_t, NaiveRing> expected = naive_rings(mesh);
    const auto classes = naive_colours(mesh.points.size(), expected);
    REQUIRE(colouring.count == std::ssize(classes));
    for (std::int32_t colour = 0; colour < colouring.count; ++colour) {
      for (const std::int32_t v : classes[static_cast<std::size_t>(colour)]) {
        REQUIRE(colouring.colours[v] == colour);
      }
    }
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto found = expected.find(v);
      REQUIRE(rings.is_free(v) == (found != expected.end()));
      if (found != expected.end()) {
        REQUIRE(std::ranges::equal(rings[v], found->second.neighbours));
        REQUIRE(std::ranges::equal(rings.view().mixed(v).opposites, found->second.opposites));
      }
    }
  }
}

/// Every way to smooth that may be asked for.
std::vector<SmoothingOptions> all_ways() {
  std::vector<SmoothingOptions> ways;
  for (const Method method : {Method::smart, Method::laplacian, Method::weighted, Method::mean_ratio}) {
    for (const Form form : {Form::in_place, Form::swap}) {
      for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        SmoothingOptions options = with(method, form);
        options.precision = precision;
        options.max_sweeps = 20;
        ways.push_back(options);
      }
    }
  }
  ways.push_back(with(Method::mean_ratio));
  ways.back().mean_ratio.target = TargetShape::input;
  ways.push_back(with(Method::mean_ratio));
  ways.back().mean_ratio.steady = true;
  ways.back().max_sweeps = 10;
  return ways;
}

TEST_CASE("no mesh of quadrilaterals comes back worse than it went in") {
  const std::vector<SmoothingOptions> ways = all_ways();
  int improved = 0;
  int inverted = 0;
  for (std::uint64_t seed = 0; seed < random_meshes; ++seed) {
    const MixedMesh mesh = mixed_meshes::random_mesh(seed);
    const Numbers before = mesh.xy();
    for (std::size_t way = seed % 3; way < ways.size(); way += 3) {
      CAPTURE(seed, way);
      Numbers after = before;
      const SmoothingResult result = smooth(xy_points(after), mesh.elements, ways[way]);
      double worst_before = 1;
      double worst_after = 1;
      std::int64_t bad = 0;
      for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        worst_before = std::min(worst_before, shape_by_definition(mesh, e, before));
        worst_after = std::min(worst_after, shape_by_definition(mesh, e, after));
        bad += shape_by_definition(mesh, e, after) > 0 ? 0 : 1;
      }
      REQUIRE(worst_after >= worst_before - 1e-14);
      REQUIRE(result.inverted + result.degenerate == bad);
      for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const double was = shape_by_definition(mesh, e, before);
        const double is = shape_by_definition(mesh, e, after);
        REQUIRE((!(was > 0) || is > 0));
      }
      improved += worst_after > worst_before ? 1 : 0;
      inverted += worst_before < 0 ? 1 : 0;
      // Boundaries are where they were.
      const std::map<std::int32_t, NaiveRing> rings = naive_rings(mesh);
      for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto place = 2 * static_cast<std::size_t>(v);
        REQUIRE((rings.contains(v) ||
                 (same_bits(after[place], before[place]) && same_bits(after[place + 1], before[place + 1]))));
      }
    }
  }
  CHECK(improved > 300);
  CHECK(inverted > 100);
}

TEST_CASE("quadrilaterals come out with the same bits by any threads and instructions, however they are listed") {
  const std::vector<SmoothingOptions> ways = all_ways();
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const MixedMesh mesh = mixed_meshes::random_mesh(seed);
    for (SmoothingOptions options : ways) {
      CAPTURE(seed, std::string(options.method_name()));
      const Numbers expected = smoothed(mesh, options);
      options.threads = 2 + static_cast<int>(seed % 3);
      REQUIRE(same_bits(smoothed(mesh, options), expected));
      REQUIRE(
          same_bits(smoothed(mesh.listed_from_other_corners(seed, true).in_another_order(seed), options), expected));
      options.evaluation = Evaluation::all;
      REQUIRE(same_bits(smoothed(mesh, options), expected));
    }
  }
  for (const std::uint64_t thirds : {0U, 1U}) {
    const MixedMesh large(150, 140, 0.4, 3, thirds);
    for (SmoothingOptions options : ways) {
      const Numbers expected = smoothed(large, options);
      options.threads = 3;
      const LimitedInstructions limited(InstructionSet::baseline);
      REQUIRE(same_bits(smoothed(large, options), expected));
    }
  }
}

TEST_CASE("a mesh of quadrilaterals that is twice as large, or turned by a right angle, comes out so to the bit") {
  for (const SmoothingOptions& options : all_ways()) {
    CAPTURE(std::string(options.method_name()));
    const MixedMesh mesh(12, 10, 0.3, 5);
    const Numbers expected = smoothed(mesh, options);
    MixedMesh larger = mesh;
    MixedMesh turned = mesh;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const auto [x, y] = mesh.points[v];
      larger.points[v] = {4 * x, 4 * y};
      turned.points[v] = {-y, x};
    }
    const Numbers of_larger = smoothed(larger, options);
    const Numbers of_turned = smoothed(turned, options);
    for (std::size_t i = 0; i < expected.size(); i += 2) {
      REQUIRE(same_bits(of_larger[i], 4 * expected[i]));
      REQUIRE(same_bits(of_larger[i + 1], 4 * expected[i + 1]));
      REQUIRE(of_turned[i] == -expected[i + 1]);
      REQUIRE(of_turned[i + 1] == expected[i]);
    }
  }
}

TEST_CASE("triangles listed by four numbers are smoothed as triangles") {
  const MixedMesh mesh(20, 20, 0.35, 9, 3);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c, d] : mesh.elements) {
    REQUIRE(d == -1);
    triangles.push_back({a, b, c});
  }
  for (const SmoothingOptions& options : all_ways()) {
    Numbers expected = mesh.xy();
    smooth(xy_points(expected), triangles, options);
    CHECK(same_bits(smoothed(mesh, options), expected));
  }
}

TEST_CASE("squares that were jittered come back as squares") {
  const MixedMesh mesh(40, 40, 0.45, 1, 0);
  for (const Method method : {Method::smart, Method::laplacian, Method::mean_ratio}) {
    const Numbers xy = [&] {
      // The border is straight again.
      MixedMesh inside = mesh;
      for (std::size_t v = 0; v < inside.points.size(); ++v) {
        const std::size_t column = v % 41;
        const std::size_t row = v / 41;
        if (column == 0 || column == 40 || row == 0 || row == 40) {
          inside.points[v] = {static_cast<double>(column), static_cast<double>(row)};
        }
      }
      return smoothed(inside, with(method));
    }();
    double worst = 1;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      worst = std::min(worst, shape_by_definition(mesh, e, xy));
    }
    CAPTURE(std::string(to_string(method)));
    CHECK(worst > 0.99);
  }
}

TEST_CASE("vertices that are named, and those between regions of quadrilaterals, stay where they are") {
  const MixedMesh mesh(20, 10, 0.3, 4);
  std::vector<std::int32_t> regions;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double middle = 0;
    for (const std::int32_t v : mesh.corners(e)) {
      middle += static_cast<double>(v % 21) / static_cast<double>(mesh.corners(e).size());
    }
    regions.push_back(middle < 10 ? 1 : 2);
  }
  const std::vector<std::int32_t> named{25, 60};
  Constraints constraints;
  constraints.regions = regions;
  constraints.fixed_ids = named;
  const Numbers before = mesh.xy();
  const Numbers after = smoothed(mesh, with(Method::mean_ratio), constraints);
  int stayed = 0;
  int moved = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const bool is_same = after[2 * v] == before[2 * v] && after[2 * v + 1] == before[2 * v + 1];
    if (v % 21 == 10 || v == 25 || v == 60) {
      REQUIRE(is_same);
      ++stayed;
    } else {
      moved += is_same ? 0 : 1;
    }
  }
  CHECK(stayed == 13);
  CHECK(moved > 100);
}

TEST_CASE("a layer of flat quadrilaterals is kept, and what is beside it gets better") {
  // Eight rows that grow away from the wall, from a hundredth of their length on, and squares above them.
  MixedMesh mesh(40, 20, 0.3, 6, 1);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto row = static_cast<int>(v / 41);
    auto& [x, y] = mesh.points[v];
    if (row <= 8) {
      x = static_cast<double>(v % 41);
      y = 0.01 * (std::pow(1.6, row) - 1) / 0.6;
    } else {
      y += 0.01 * (std::pow(1.6, 8) - 1) / 0.6 - 8;
    }
  }
  std::erase_if(mesh.elements, [](const auto& e) { return e[3] < 0 && e[0] / 41 < 8; });
  for (std::int32_t row = 0; row < 8; ++row) {
    for (std::int32_t column = 0; column < 40; ++column) {
      const std::int32_t a = row * 41 + column;
      const mixed_meshes::Element quadrilateral{a, a + 1, a + 42, a + 41};
      if (std::ranges::count(mesh.elements, quadrilateral) == 0) {
        mesh.elements.push_back(quadrilateral);
      }
    }
  }
  Numbers xy = mesh.xy();
  const Numbers before = xy;
  SmoothingOptions options = with(Method::mean_ratio);
  const SmoothingResult result = smooth(xy_points(xy), mesh.elements, options);
  CHECK(result.layers.kept > 150);
  for (std::size_t v = 0; v < 5 * 41; ++v) {
    REQUIRE((same_bits(xy[2 * v], before[2 * v]) && same_bits(xy[2 * v + 1], before[2 * v + 1])));
  }
  CHECK(!same_bits(xy, before));
  options.layers = Layers::smooth;
  Numbers flattened = before;
  CHECK(smooth(xy_points(flattened), mesh.elements, options).layers.kept == 0);
  CHECK(!std::equal(flattened.begin(), flattened.begin() + std::ptrdiff_t{5 * 82}, before.begin()));
}

TEST_CASE("the smallest shape of quadrilaterals is recorded, and a target for it ends the sweeps") {
  const MixedMesh mesh(30, 30, 0.3, 12);
  Numbers xy = mesh.xy();
  SmoothingOptions options = with(Method::mean_ratio);
  options.record_min_shape = true;
  const SmoothingResult result = smooth(xy_points(xy), mesh.elements, options);
  REQUIRE(!result.history.empty());
  const QualityReport report = quality(xy_points(std::as_const(xy)), mesh.elements);
  CHECK(result.history.back().min_shape == Approx(report[Metric::shape].min).epsilon(1e-12));
  const double target = result.history[result.history.size() / 2].min_shape;
  options.target_quality = target;
  Numbers sooner = mesh.xy();
  const SmoothingResult ended = smooth(xy_points(sooner), mesh.elements, options);
  CHECK(ended.stop_reason == StopReason::quality_target);
  CHECK(ended.sweeps <= result.sweeps);
  CHECK(quality(xy_points(std::as_const(sooner)), mesh.elements)[Metric::shape].min >= target - 1e-12);
}

TEST_CASE("a plan of quadrilaterals smooths as often as it is asked, as smooth() does") {
  const MixedMesh mesh(25, 20, 0.4, 2);
  for (const SmoothingOptions& options : all_ways()) {
    SmoothingPlan kept = plan(mesh.vertex_count(), mesh.elements, options);
    for (int time = 0; time < 2; ++time) {
      Numbers xy = mesh.xy();
      kept.smooth(xy);
      CHECK(same_bits(xy, smoothed(mesh, options)));
    }
  }
}

TEST_CASE("sizes that are asked for are those of quadrilaterals too") {
  const MixedMesh mesh(30, 30, 0.1, 3, 0);
  std::vector<double> lengths;
  for (const auto& [x, y] : mesh.points) {
    lengths.push_back(0.5 + x / 30);
  }
  SmoothingOptions options = with(Method::mean_ratio);
  options.mean_ratio.target_lengths = lengths;
  options.max_sweeps = 200;
  const Numbers xy = smoothed(mesh, options);
  const auto width = [&](std::size_t column) {
    double sum = 0;
    for (std::size_t row = 5; row < 26; ++row) {
      sum += xy[2 * (row * 31 + column + 1)] - xy[2 * (row * 31 + column)];
    }
    return sum / 21;
  };
  CHECK(width(3) < 0.95);
  CHECK(width(26) > 1.05);
}

TEST_CASE("what quadrilaterals cannot have is refused, and nothing moves") {
  const MixedMesh mesh(6, 6, 0.2, 1);
  const auto refused = [&](const SmoothingOptions& options, const Constraints& constraints = {}) {
    Numbers xy = mesh.xy();
    const std::string said = refusal([&] { smooth(xy_points(xy), mesh.elements, constraints, options); });
    CHECK(same_bits(xy, mesh.xy()));
    return said;
  };
  const std::vector<std::int32_t> regions(3);
  Constraints wrong;
  wrong.regions = regions;
  CHECK(refused(with(Method::smart), wrong).find("Constraints::regions has 3 entries") != std::string::npos);
  MixedMesh faulty = mesh;
  faulty.elements[4][2] = 1000;
  Numbers xy = faulty.xy();
  CHECK(refusal([&] { smooth(xy_points(xy), faulty.elements); }) ==
        "mesh: element 4 names vertex 1000; vertices are numbered from 0 to 48");
  faulty.elements[4] = faulty.elements[3];
  std::swap(faulty.elements[4][0], faulty.elements[4][2]);
  faulty.elements[4][0] = faulty.elements[4][1];
  CHECK(refusal([&] { smooth(xy_points(xy), faulty.elements); }) == "mesh: element 4 repeats a vertex");
  faulty.elements[4] = {0, 1, 8, 8};
  CHECK(refusal([&] { smooth(xy_points(xy), faulty.elements); }) ==
        "mesh: element 4 repeats a vertex; of a triangle the last of four numbers is -1");
  for (const auto& wrong_place : {mixed_meshes::Element{0, -1, 8, 7}, {0, 1, -1, -1}}) {
    faulty.elements[4] = wrong_place;
    CHECK(refusal([&] { smooth(xy_points(xy), faulty.elements); }) ==
          "mesh: element 4 names vertex -1, which is no vertex: only the last of four numbers is -1, of a triangle");
  }
}

}  // namespace trismooth::smooth_quadrilaterals_test
