#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_mean_ratio.h"
#include "support/naive_smoothing.h"
#include "support/sanitized.h"
#include "support/test_meshes.h"

using naive::Real;
using trismooth::Form;
using trismooth::MeanRatio;
using trismooth::MeanRatioOptions;
using trismooth::MeanRatioScales;
using trismooth::MeanRatioStep;
using trismooth::MeanRatioTargets;
using trismooth::Method;
using trismooth::Move;
using trismooth::Point2;
using trismooth::SmoothingOptions;
using trismooth::TargetShape;

namespace mean_ratio_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A vertex, number 0, in a ring, numbers 1, 2, ..., and what the method aims at there.
template <class T>
struct Scene {
  std::vector<Point2<T>> positions;  ///< of the ring
  Point2<T> position{0, 0};
  std::vector<T> inverse_areas;  ///< by number
  T largest_share = std::numeric_limits<T>::infinity();
  MeanRatioScales<T> scales;
  std::vector<trismooth::EdgeTensor<T>> edges;  ///< by number, or none

  int size() const { return static_cast<int>(positions.size()); }
  Point2<T> operator[](int i) const { return positions[static_cast<std::size_t>(i)]; }
  static std::int32_t number(int i) { return i + 1; }

  Move<T> visit(const MeanRatioStep<T>& step) const {
    MeanRatioTargets<T> targets{inverse_areas.data(), &largest_share, &scales};
    if (!edges.empty()) {
      targets.edges = edges.data();
    }
    return trismooth::visit_mean_ratio(targets, step,
                                       [&](const auto& method) { return method.update(0, position, *this); });
  }

  /// The same as its definition sees it.
  naive::EnergyRing energy(bool is_last) const {
    naive::EnergyRing ring;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      ring.positions.push_back(naive::widened(positions[i]));
      ring.inverse_areas.push_back(static_cast<Real>(inverse_areas[i + 1]));
      if (!edges.empty()) {
        ring.edges.push_back(widened(edges[i + 1]));
      }
    }
    ring.own_edges = edges.empty() ? naive::Tensor{} : widened(edges[0]);
    ring.own_inverse_area = static_cast<Real>(inverse_areas[0]);
    ring.third_of_weight = static_cast<Real>(scales.size_weight);
    ring.power = is_last ? scales.power : 1;
    return ring;
  }
  static naive::Tensor widened(const trismooth::EdgeTensor<T>& tensor) {
    return {static_cast<Real>(tensor.xx), static_cast<Real>(tensor.xy), static_cast<Real>(tensor.yy)};
  }
};

/// Round enough for the origin to see all of it; with areas to be aimed at about those that there are.
template <class T>
Scene<T> star(test_meshes::Random& random, bool has_edges) {
  Scene<T> scene;
  const std::int32_t size = 3 + random.below(9);
  const auto around = [&](double spread) {
    std::vector<Point2<T>> places;
    for (std::int32_t i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random.between(-spread, spread)) / size;
      const double radius = random.between(0.4, 1.6);
      places.push_back({static_cast<T>(radius * std::cos(angle)), static_cast<T>(radius * std::sin(angle))});
    }
    return places;
  };
  scene.positions = around(0.3);
  if (has_edges) {
    for (const Point2<T> p : around(0.2)) {
      trismooth::EdgeTensor<T> edges{static_cast<T>(random.between(0.1, 1)), 0, static_cast<T>(random.between(0.1, 1))};
      edges.add(p);
      scene.edges.push_back(edges);
    }
    // Fixed vertices have none.
    scene.edges[static_cast<std::size_t>(random.below(size))] = {};
    scene.edges.insert(scene.edges.begin(), trismooth::EdgeTensor<T>{1, static_cast<T>(0.25), static_cast<T>(0.5)});
  }
  for (std::int32_t i = 0; i <= size; ++i) {
    scene.inverse_areas.push_back(static_cast<T>(size / random.between(2, 10)));
  }
  scene.scales = {static_cast<T>(random.below(3) == 0 ? 0 : random.between(0, 0.5)), 1 + random.below(8)};
  return scene;
}

/// The same with the vertex at a random place where all triangles are positive.
template <class T>
Scene<T> valid_scene(test_meshes::Random& random, bool has_edges) {
  for (;;) {
    Scene<T> scene = star<T>(random, has_edges);
    scene.position = {static_cast<T>(random.between(-0.5, 0.5)), static_cast<T>(random.between(-0.5, 0.5))};
    if (scene.energy(true).smallest_area(naive::widened(scene.position)) > 1e-2L) {
      return scene;
    }
  }
}

struct Derivatives {
  Real x, y, xx, xy, yy;
};

/// By differences of the fourth order.
Derivatives differences(const naive::EnergyRing& ring, Point2<Real> v) {
  const Real h = 1e-4L * ring.smallest_area(v);
  const auto at = [&](int i, int j) { return ring.energy({v.x + h * i, v.y + h * j}); };
  const auto first = [&](const auto& f) { return (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * h); };
  const auto second = [&](const auto& f) { return (16 * (f(1) + f(-1)) - (f(2) + f(-2)) - 30 * f(0)) / (12 * h * h); };
  const auto along_x = [&](int i) { return at(i, 0); };
  const auto along_y = [&](int i) { return at(0, i); };
  const auto mixed = [&](int i) { return (at(i, i) + at(-i, -i) - at(i, -i) - at(-i, i)) / (4 * h * h * i * i); };
  return {first(along_x), first(along_y), second(along_x), (4 * mixed(1) - mixed(2)) / 3, second(along_y)};
}

struct NewtonStep {
  Point2<Real> step;
  Real gain;  ///< twice what it gains where the energy is quadratic
};

NewtonStep newton_step(const naive::EnergyRing& ring, Point2<Real> v) {
  const Derivatives d = differences(ring, v);
  const Real determinant = d.xx * d.yy - d.xy * d.xy;
  const Point2<Real> step{(d.xy * d.y - d.yy * d.x) / determinant, (d.xy * d.x - d.xx * d.y) / determinant};
  return {step, -(step.x * d.x + step.y * d.y)};
}

/// Whether no triangle is larger than the bound that was not as large before, by a part `slack` of the bound.
template <class T>
bool is_within_bound(const Scene<T>& scene, Point2<Real> target, Real slack) {
  const naive::EnergyRing ring = scene.energy(true);
  for (std::size_t i = 0; i < ring.positions.size(); ++i) {
    const Real before = naive::share(naive::widened(scene.position), ring.positions[i], ring.positions[ring.next(i)]);
    const Real after = naive::share(target, ring.positions[i], ring.positions[ring.next(i)]);
    if (after > std::max(before, static_cast<Real>(scene.largest_share)) * (1 + slack)) {
      return false;
    }
  }
  return true;
}

/// A bound that some of the triangles exceed, or will, or none.
template <class T>
void bound_growth(Scene<T>& scene, test_meshes::Random& random) {
  Real largest = 0;
  const naive::EnergyRing ring = scene.energy(true);
  for (std::size_t i = 0; i < ring.positions.size(); ++i) {
    largest = std::max(largest,
                       naive::share(naive::widened(scene.position), ring.positions[i], ring.positions[ring.next(i)]));
  }
  scene.largest_share = static_cast<T>(largest * random.between(0.3, 2));
}

/// Where the energy is smallest: the best of eight places around, nearer and nearer.
Point2<Real> lowest(const naive::EnergyRing& ring, Point2<Real> from) {
  Real best = ring.energy(from);
  for (Real step = 0.25L; step > 1e-9L;) {
    Point2<Real> next = from;
    for (int i = 0; i < 8; ++i) {
      const Real angle = i * std::numbers::pi_v<Real> / 4 + step;
      const Point2<Real> place{from.x + step * std::cos(angle), from.y + step * std::sin(angle)};
      if (ring.smallest_area(place) > 0 && ring.energy(place) < best) {
        best = ring.energy(place);
        next = place;
      }
    }
    step = next == from ? step / 2 : step;
    from = next;
  }
  return from;
}

Real distance(Point2<Real> a, Point2<Real> b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// A grid of `side` x `side` points, sheared and flattened, none of its triangles near equilateral: all alike, or the
/// flatter the lower they lie.
test_meshes::Mesh sheared_grid(std::int32_t side, bool is_graded) {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0, 1);
  mesh.triangles.clear();
  for (std::int32_t j = 0; j + 1 < side; ++j) {
    for (std::int32_t i = 0; i + 1 < side; ++i) {
      const std::int32_t a = j * side + i;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + side + 1}, {a, a + side + 1, a + side}});
    }
  }
  // Powers of two: coordinates and areas are exact.
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const int i = v % side;
    const int j = v / side;
    mesh.points[v] = {(i + 0.5 * j) / 64, (is_graded ? j * j : j) / 256.0};
  }
  return mesh;
}

struct Smoothed {
  std::vector<double> xy;
  trismooth::SmoothingResult result;
};

Smoothed smoothed(const test_meshes::Mesh& mesh, const MeanRatioOptions& mean_ratio, Form form = Form::in_place) {
  Smoothed run{mesh.xy(), {}};
  SmoothingOptions options;
  options.method = Method::mean_ratio;
  options.mean_ratio = mean_ratio;
  options.form = form;
  options.threads = 1;
  run.result = trismooth::smooth(trismooth::xy_points(run.xy), mesh.indices(), {}, options);
  return run;
}

trismooth::MetricSummary shapes(const test_meshes::Mesh& mesh, const std::vector<double>& xy) {
  return trismooth::quality(trismooth::xy_points(xy), mesh.indices())[trismooth::Metric::shape];
}

TEST_CASE("a visit makes the first step of those tried that lowers the energy, as the energy's differences say") {
  test_meshes::Random random(1);
  int moves = 0;
  int shortened = 0;
  int stays = 0;
  for (int i = 0; i < (is_sanitized ? 300 : 4000); ++i) {
    Scene<double> scene = valid_scene<double>(random, i % 3 == 0);
    if (random.below(2) == 0) {
      bound_growth(scene, random);
    }
    const double relaxation = std::vector{0.7, 1.0, 1.5, 1.9}[random.below(4)];
    const MeanRatioStep<double> step{relaxation, random.below(2) == 0 ? 0 : 3e-4, random.below(2) == 0};
    const naive::EnergyRing ring = scene.energy(step.is_last);
    const Point2<Real> from = naive::widened(scene.position);
    const NewtonStep newton = newton_step(ring, from);
    const Real before = ring.energy(from);
    CAPTURE(i, scene.size(), scene.scales.power, relaxation, step.is_last);

    const Move<double> move = scene.visit(step);
    bool is_clear = std::abs(newton.gain - step.least_gain * before) > 1e-6L * before;
    if (!is_clear) {
      continue;
    }
    Point2<Real> expected = from;
    if (newton.gain > step.least_gain * before) {
      Real length = relaxation;
      for (int tries = 0; tries < 4 && expected == from; ++tries) {
        const Point2<Real> target{from.x + length * newton.step.x, from.y + length * newton.step.y};
        const Real area = ring.smallest_area(target);
        is_clear = is_clear && std::abs(area) > 1e-5L;
        if (area > 0) {
          const Real after = ring.energy(target);
          is_clear = is_clear && std::abs(after - before) > 1e-5L * before &&
                     is_within_bound(scene, target, 1e-5L) == is_within_bound(scene, target, -1e-5L);
          expected = after < before && is_within_bound(scene, target, 0) ? target : from;
        }
        shortened += tries > 0 && !(expected == from) ? 1 : 0;
        length = length > 1 ? 1 : length / 2;
      }
    }
    if (is_clear) {
      const Real off = distance(naive::widened(move.position), expected);
      REQUIRE(static_cast<double>(off) < 4e-6 + 4e-6 * static_cast<double>(distance(expected, from)));
      moves += move.moved ? 1 : 0;
      stays += move.moved ? 0 : 1;
    }
  }
  CHECK(moves > (is_sanitized ? 100 : 2000));
  CHECK(shortened > (is_sanitized ? 10 : 100));
  CHECK(stays > (is_sanitized ? 5 : 100));
}

TEMPLATE_TEST_CASE("every move lowers the energy, leaves all triangles positive, and none grows beyond the bound", "",
                   float, double) {
  test_meshes::Random random(2);
  constexpr Real rounding = 64 * static_cast<Real>(std::numeric_limits<TestType>::epsilon());
  int moves = 0;
  for (int i = 0; i < (is_sanitized ? 2000 : 20000); ++i) {
    Scene<TestType> scene = valid_scene<TestType>(random, i % 3 == 0);
    bound_growth(scene, random);
    const MeanRatioStep<TestType> step{static_cast<TestType>(random.between(0.5, 2)), 0, random.below(2) == 0};
    const Move<TestType> move = scene.visit(step);
    if (!move.moved) {
      REQUIRE(move.position == scene.position);
      continue;
    }
    ++moves;
    const naive::EnergyRing ring = scene.energy(step.is_last);
    const Point2<Real> to = naive::widened(move.position);
    CAPTURE(i, scene.scales.power);
    REQUIRE(ring.smallest_area(to) > 0);
    REQUIRE(ring.energy(to) < ring.energy(naive::widened(scene.position)) * (1 + scene.scales.power * rounding));
    REQUIRE(is_within_bound(scene, to, rounding));
  }
  CHECK(moves > (is_sanitized ? 1000 : 10000));
}

TEST_CASE("visits again and again end where the energy of the ring is smallest, and there the vertex stays") {
  test_meshes::Random random(3);
  for (int i = 0; i < (is_sanitized ? 40 : 300); ++i) {
    Scene<double> scene = valid_scene<double>(random, i % 3 == 0);
    const bool is_last = random.below(2) == 0;
    const naive::EnergyRing ring = scene.energy(is_last);
    const Point2<Real> expected = lowest(ring, naive::widened(scene.position));
    for (int visits = 0; visits < 60; ++visits) {
      scene.position = scene.visit({visits % 2 == 0 ? 1.5 : 1.0, 0, is_last}).position;
    }
    CAPTURE(i, scene.size(), scene.scales.power, scene.scales.size_weight);
    REQUIRE(static_cast<double>(distance(naive::widened(scene.position), expected)) < 1e-6);
    REQUIRE_FALSE(scene.visit({1.5, 1e-10, is_last}).moved);
    // Single precision gets there, too.
    Scene<float> narrow;
    for (const Point2<double> p : scene.positions) {
      narrow.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
    }
    for (const auto& edges : scene.edges) {
      narrow.edges.push_back(
          {static_cast<float>(edges.xx), static_cast<float>(edges.xy), static_cast<float>(edges.yy)});
    }
    narrow.inverse_areas.assign(scene.inverse_areas.begin(), scene.inverse_areas.end());
    narrow.scales = {static_cast<float>(scene.scales.size_weight), scene.scales.power};
    narrow.position = {static_cast<float>(expected.x), static_cast<float>(expected.y)};
    REQUIRE_FALSE(narrow.visit({1.5F, 1e-5F, is_last}).moved);
  }
}

TEMPLATE_TEST_CASE("in the middle of equilateral triangles of the area aimed at a vertex stays", "", float, double) {
  for (int power = 1; power <= 8; ++power) {
    for (const double weight : {0.0, 1.0, 100.0}) {
      Scene<TestType> scene;
      for (int i = 0; i < 6; ++i) {
        const double angle = std::numbers::pi * i / 3 + 0.2;
        scene.positions.push_back({static_cast<TestType>(std::cos(angle)), static_cast<TestType>(std::sin(angle))});
      }
      scene.inverse_areas.assign(7, static_cast<TestType>(2 / std::numbers::sqrt3));
      scene.scales = {static_cast<TestType>(weight / 3), power};
      for (const bool is_last : {false, true}) {
        CHECK_FALSE(scene.visit({static_cast<TestType>(1.5), static_cast<TestType>(1e-4), is_last}).moved);
      }
    }
  }
}

TEMPLATE_TEST_CASE("around an inverted or flat triangle, and where a position is no number, it is the smart rule", "",
                   float, double) {
  test_meshes::Random random(4);
  int moves = 0;
  for (int i = 0; i < 3000; ++i) {
    Scene<TestType> scene = star<TestType>(random, i % 3 == 0);
    const int kind = i % 4;
    const auto which = static_cast<std::size_t>(random.below(scene.size()));
    if (kind == 0) {
      scene.position = {static_cast<TestType>(random.between(-2, 2)), 2};
    } else if (kind == 1) {
      scene.position = scene.positions[which];
    } else if (kind == 2) {
      const TestType bad =
          random.below(2) == 0 ? std::numeric_limits<TestType>::quiet_NaN() : std::numeric_limits<TestType>::infinity();
      (random.below(2) == 0 ? scene.positions[which].x : scene.positions[which].y) = bad;
    } else {
      scene.position.x = std::numeric_limits<TestType>::quiet_NaN();
    }
    const Move<TestType> move = scene.visit({static_cast<TestType>(1.5), static_cast<TestType>(3e-4), i % 2 == 0});
    CAPTURE(i, kind);
    if (kind < 2) {
      const Point2<TestType> expected = naive::updated(Method::smart, scene.position, scene.positions);
      REQUIRE(move.position == expected);
      REQUIRE(move.moved == !(expected == scene.position));
    } else {
      REQUIRE_FALSE(move.moved);
    }
    moves += move.moved ? 1 : 0;
  }
  CHECK(moves > 1000);
}

TEST_CASE("a sheared grid of equal areas does not move where it keeps its shapes") {
  const test_meshes::Mesh grid = sheared_grid(12, false);
  for (const Form form : {Form::swap, Form::in_place}) {
    const Smoothed kept = smoothed(grid, {1, 0, TargetShape::input}, form);
    CHECK(kept.result.moved_vertices == 0);
    CHECK(kept.xy == grid.xy());
    CHECK(kept.result.stop_reason == trismooth::StopReason::fixed_point);
  }
}

/// Layers of a grid, jittered, turned by `angle`: `aspect` times as long as high at the bottom, each 1.1 times as high
/// as the one below.
struct Layers {
  static constexpr std::int32_t side = 31;
  double aspect = 20;
  double angle = 0;

  double height(double layer) const { return std::pow(1.1, layer) / aspect; }
  test_meshes::Mesh mesh(double jitter) const {
    test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, jitter, 3);
    for (auto& p : mesh.points) {
      const double x = p.x * (side - 1);
      const double y = (std::pow(1.1, p.y * (side - 1)) - 1) / 0.1 / aspect;
      p = {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
    }
    return mesh;
  }
  /// Shapes of the triangles, each stretched by as much as its layers are flattened: 1 is equilateral then.
  trismooth::MetricSummary shapes(const test_meshes::Mesh& mesh, const std::vector<double>& xy) const {
    test_meshes::Mesh stretched;
    for (const auto& t : mesh.triangles) {
      double layer = 0;
      for (const std::int32_t v : t) {
        const int row = v / side;  // of the grid, wherever the vertex is now
        layer += row / 3.0;
      }
      for (const std::int32_t v : t) {
        const double x = xy[2 * static_cast<std::size_t>(v)];
        const double y = xy[2 * static_cast<std::size_t>(v) + 1];
        stretched.points.push_back(
            {std::cos(angle) * x + std::sin(angle) * y, (std::cos(angle) * y - std::sin(angle) * x) / height(layer)});
      }
      const std::int32_t first = stretched.vertex_count() - 3;
      stretched.triangles.push_back({first, first + 1, first + 2});
    }
    return mean_ratio_test::shapes(stretched, stretched.xy());
  }
};

TEST_CASE("layers that are flat on purpose stay as flat as they are, and what is badly made in them gets better") {
  for (const Layers layers : {Layers{20, 0}, Layers{20, 0.5}, Layers{200, 1}}) {
    const test_meshes::Mesh mesh = layers.mesh(0.25);
    const auto before = layers.shapes(mesh, mesh.xy());
    for (const Form form : {Form::swap, Form::in_place}) {
      const Smoothed kept = smoothed(mesh, {1, 0, TargetShape::input}, form);
      const auto after = layers.shapes(mesh, kept.xy);
      CAPTURE(layers.aspect, layers.angle, form, before.min, before.mean, after.min, after.mean);
      CHECK(before.mean < 0.83);
      CHECK(after.mean > 0.92);
      CHECK(after.min > before.min + 0.1);
    }
    // Equilateral triangles are other ones.
    CHECK(layers.shapes(mesh, smoothed(mesh, {1, 0, TargetShape::uniform}).xy).mean < before.mean);
  }
}

TEST_CASE("a mesh that is not flat on purpose gets nearly as good as where equilateral triangles are aimed at") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 7);
  const auto kept = shapes(mesh, smoothed(mesh, {1, 0, TargetShape::input}).xy);
  const auto uniform = shapes(mesh, smoothed(mesh, {1, 0, TargetShape::uniform}).xy);
  CHECK(kept.mean > uniform.mean - 0.02);
  CHECK(kept.min > shapes(mesh, mesh.xy()).min + 0.1);
}

TEST_CASE("every power makes shapes better, and high ones see to the worst") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.35, 7);
  const auto before = shapes(mesh, mesh.xy());
  std::vector<trismooth::MetricSummary> after;
  for (int power = 1; power <= 8; ++power) {
    CAPTURE(power);
    const Smoothed run = smoothed(mesh, {0, power, TargetShape::uniform});
    after.push_back(shapes(mesh, run.xy));
    CHECK(after.back().mean > before.mean + 0.1);
    CHECK(after.back().min > before.min + 0.1);
    CHECK(run.result.reverted_vertices == 0);
  }
  CHECK(after[7].min > after[0].min + 0.02);
}

TEST_CASE("the more sizes weigh, the nearer areas are to the means around them before") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(30, 30, 0.3, 8);
  const auto frame = trismooth::local_frame(mesh.points);
  std::vector<Point2<double>> local;
  for (const auto p : mesh.points) {
    local.push_back(frame.enter(p));
  }
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  const auto aims = naive::mean_ratio_aims(local, rings, {});
  const auto deviation = [&](const std::vector<double>& xy) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
      const auto at = [&](int i) {
        return naive::widened(
            frame.enter({xy[2 * static_cast<std::size_t>(t[i])], xy[2 * static_cast<std::size_t>(t[i]) + 1]}));
      };
      const Real inverse = (aims.inverse_areas[t[0]] + aims.inverse_areas[t[1]] + aims.inverse_areas[t[2]]) / 3.0L;
      const auto log = static_cast<double>(std::log(naive::doubled_area(at(0), at(1), at(2)) * inverse));
      sum += log * log;
    }
    return std::sqrt(sum / static_cast<double>(mesh.triangles.size()));
  };
  double last = infinity;
  double last_mean = infinity;
  for (const double weight : {0.0, 3.0, 30.0, 1000.0}) {
    const Smoothed run = smoothed(mesh, {weight, 1, TargetShape::uniform});
    CAPTURE(weight, last, deviation(run.xy), shapes(mesh, run.xy).mean);
    CHECK(deviation(run.xy) < last);
    CHECK(shapes(mesh, run.xy).mean < last_mean);
    last = deviation(run.xy);
    last_mean = shapes(mesh, run.xy).mean;
  }
}

TEST_CASE("options of the method out of range are refused") {
  for (const double weight : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    SmoothingOptions options;
    options.mean_ratio.size_weight = weight;
    CHECK_THROWS_AS(options.validate(), std::invalid_argument);
  }
  for (const int power : {-1, 9}) {
    SmoothingOptions options;
    options.mean_ratio.power = power;
    CHECK_THROWS_AS(options.validate(), std::invalid_argument);
  }
  SmoothingOptions options;
  options.mean_ratio = {0, 8, TargetShape::input};
  CHECK_NOTHROW(options.validate());
}

}  // namespace mean_ratio_test
