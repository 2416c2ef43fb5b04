// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/point_view.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "trismooth/base/rounding.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/refusal.h"
#include "support/test_meshes.h"

namespace trismooth::point_view_test {

using test_meshes::Mesh;
using test_support::refusal;

template <class Points>
concept Smoothable = requires(Points&& points, const std::vector<std::int32_t>& triangles) {
  smooth(std::forward<Points>(points), triangles);
};

using Doubles = std::vector<double>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Plain arrays could be pairs or triples.
static_assert(!Smoothable<Doubles&>);
static_assert(!Smoothable<Doubles>);
static_assert(!Smoothable<std::vector<float>&>);
static_assert(!Smoothable<std::span<double>>);
static_assert(!Smoothable<double (&)[12]>);
static_assert(!Smoothable<Eigen::VectorXd&>);
static_assert(!Smoothable<Eigen::Map<Eigen::VectorXd>>);
// (Matrices whose type does not say whether rows or columns are points: see ../refuse_mesh_types.py.)
// Numbers that are none of ours, that cannot be written, or that are gone before anybody sees the result.
static_assert(!Smoothable<std::vector<std::array<int, 2>>&>);
static_assert(!Smoothable<std::vector<std::array<double, 4>>&>);
static_assert(!Smoothable<const std::vector<std::array<double, 2>>&>);
static_assert(!Smoothable<std::span<const std::array<double, 2>>>);
static_assert(!Smoothable<std::vector<std::array<double, 2>>>);
static_assert(!Smoothable<const Eigen::Matrix2Xd&>);
static_assert(!Smoothable<Eigen::Matrix2Xd>);
template <class Numbers>
concept Wrapped = requires(Numbers&& numbers) {
  xy_points(std::forward<Numbers>(numbers));
};
static_assert(Wrapped<Doubles&> && Wrapped<std::span<float>> && Wrapped<Eigen::VectorXd&>);
static_assert(!Wrapped<Doubles> && !Wrapped<const Doubles> && !Wrapped<Eigen::VectorXd>);
// What is const can be read and not smoothed.
static_assert(Wrapped<const Doubles&> && Wrapped<std::span<const float>> && Wrapped<const Eigen::VectorXd&>);
static_assert(std::same_as<decltype(xy_points(std::declval<const Doubles&>())), ConstPointView>);
static_assert(std::same_as<decltype(xy_points(std::declval<Doubles&>())), PointView>);
static_assert(std::same_as<decltype(xyz_points(std::declval<const float*>(), 1)), ConstPointView>);
static_assert(!Smoothable<ConstPointView> && Smoothable<PointView>);
static_assert(std::convertible_to<const std::vector<std::array<double, 2>>&, ConstPointView>);
static_assert(std::convertible_to<const Eigen::Matrix2Xd&, ConstPointView>);
static_assert(std::convertible_to<PointView, ConstPointView> && !std::convertible_to<ConstPointView, PointView>);
static_assert(!std::convertible_to<std::vector<std::array<double, 2>>, ConstPointView>);
static_assert(!std::convertible_to<Eigen::Matrix2Xd, ConstPointView>);
// Types that say how many numbers a point has.
static_assert(Smoothable<std::vector<std::array<double, 2>>&> && Smoothable<std::vector<std::array<float, 3>>&>);
static_assert(Smoothable<std::span<Point2<float>>> && Smoothable<double (&)[5][3]>);
static_assert(Smoothable<std::vector<Eigen::Vector2f>&> && Smoothable<std::vector<Eigen::Vector3d>&>);
static_assert(Smoothable<Eigen::Matrix2Xd&> && Smoothable<Eigen::Matrix<float, Eigen::Dynamic, 3>&>);
static_assert(Smoothable<Eigen::Map<RowMatrix>> && Smoothable<Eigen::Ref<Eigen::Matrix2Xd>&>);

struct Node {
  std::int64_t id;
  double x;
  double y;
  double height;
};

/// Points in memory of some form: their numbers, and everything else in that memory, which nobody may touch.
struct Form {
  std::string name;
  std::function<void(const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy)> smooth_as;
};

/// Fills `memory` with a pattern and the points, smooths it as `view` sees it, and reads the points back. `number(v,
/// k)` is a reference to number k of vertex v.
template <class Memory, class Number, class View>
void smooth_in(Memory& memory, const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy,
               std::size_t components, const Number& number, const View& view) {
  using T = std::remove_reference_t<decltype(number(0, 0))>;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    number(v, 0) = static_cast<T>(mesh.points[v].x);
    number(v, 1) = static_cast<T>(mesh.points[v].y);
    if (components == 3) {
      number(v, 2) = T(7.25);
    }
  }
  const Memory before = memory;
  smooth(view(), mesh.indices(), {}, options);
  xy.clear();
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    xy.insert(xy.end(), {static_cast<double>(number(v, 0)), static_cast<double>(number(v, 1))});
  }
  // With the old points back, all is as it was.
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    number(v, 0) = static_cast<T>(mesh.points[v].x);
    number(v, 1) = static_cast<T>(mesh.points[v].y);
  }
  REQUIRE(std::memcmp(memory.data(), before.data(), before.size() * sizeof(*before.data())) == 0);
}

template <class T>
std::vector<Form> forms_of() {
  const auto tuples = []<std::size_t n>(std::integral_constant<std::size_t, n>) {
    return [](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
      std::vector<std::array<T, n>> points(mesh.points.size());
      smooth_in(
          points, mesh, options, xy, n, [&](std::size_t v, std::size_t k) -> T& { return points[v][k]; },
          [&]() -> PointView { return points; });
    };
  };
  const auto numbers = [](std::size_t n) {
    return [n](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
      std::vector<T> array(n * mesh.points.size());
      smooth_in(
          array, mesh, options, xy, n, [&](std::size_t v, std::size_t k) -> T& { return array[n * v + k]; },
          [&] { return n == 2 ? xy_points(array) : xyz_points(array); });
    };
  };
  const auto matrix = []<class M>(const M& /*type*/, bool in_columns, bool by_type) {
    return [=](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
      const auto count = static_cast<Eigen::Index>(mesh.points.size());
      const Eigen::Index n = in_columns ? (M::RowsAtCompileTime > 0 ? M::RowsAtCompileTime : 3)
                                        : (M::ColsAtCompileTime > 0 ? M::ColsAtCompileTime : 3);
      M points = in_columns ? M(n, count) : M(count, n);
      smooth_in(
          points, mesh, options, xy, static_cast<std::size_t>(n),
          [&](std::size_t v, std::size_t k) -> T& {
            const auto i = static_cast<Eigen::Index>(v);
            const auto j = static_cast<Eigen::Index>(k);
            return in_columns ? points(j, i) : points(i, j);
          },
          [&]() -> PointView {
            if constexpr (M::RowsAtCompileTime != Eigen::Dynamic || M::ColsAtCompileTime != Eigen::Dynamic) {
              if (by_type) {
                return points;
              }
            }
            return in_columns ? trismooth::point_columns(points) : trismooth::point_rows(points);
          });
    };
  };
  constexpr int any = Eigen::Dynamic;
  return {
      {"pairs", tuples(std::integral_constant<std::size_t, 2>())},
      {"triples", tuples(std::integral_constant<std::size_t, 3>())},
      {"x, y, x, y", numbers(2)},
      {"x, y, z, x, y, z", numbers(3)},
      {"a matrix of columns", matrix(Eigen::Matrix<T, 2, any>(), true, true)},
      {"a matrix of columns of three", matrix(Eigen::Matrix<T, 3, any>(), true, true)},
      {"a matrix of rows, column by column", matrix(Eigen::Matrix<T, any, 3>(), false, true)},
      {"a matrix of rows, row by row", matrix(Eigen::Matrix<T, any, 2, Eigen::RowMajor>(), false, true)},
      {"any matrix by its rows", matrix(Eigen::Matrix<T, any, any>(), false, false)},
      {"any matrix by its columns", matrix(Eigen::Matrix<T, any, any>(), true, false)},
      {"every second of an array, backwards",
       [](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
         std::vector<T> array(7 * mesh.points.size() + 4, T(0.5));
         T* const last = array.data() + 7 * (mesh.points.size() - 1) + 1;
         smooth_in(
             array, mesh, options, xy, 2,
             [&](std::size_t v, std::size_t k) -> T& { return *(last - 7 * static_cast<std::ptrdiff_t>(v) + k); },
             [&] { return xy_points(last, mesh.points.size(), -7 * static_cast<std::ptrdiff_t>(sizeof(T))); });
       }},
  };
}

std::vector<Form> double_forms() {
  std::vector<Form> forms = forms_of<double>();
  forms.push_back({"structs", [](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
                     std::vector<Node> nodes(mesh.points.size(), Node{-1, 0, 0, 0});
                     smooth_in(
                         nodes, mesh, options, xy, 3,
                         [&](std::size_t v, std::size_t k) -> double& {
                           return k == 0 ? nodes[v].x : k == 1 ? nodes[v].y : nodes[v].height;
                         },
                         [&] { return xyz_points(&nodes[0].x, nodes.size(), sizeof(Node)); });
                   }});
  forms.push_back(
      {"vectors of Eigen", [](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
         std::vector<Eigen::Vector3d> points(mesh.points.size());
         smooth_in(
             points, mesh, options, xy, 3,
             [&](std::size_t v, std::size_t k) -> double& { return points[v][static_cast<Eigen::Index>(k)]; },
             [&]() -> PointView { return points; });
       }});
  forms.push_back(
      {"a map with gaps", [](const Mesh& mesh, const SmoothingOptions& options, std::vector<double>& xy) {
         std::vector<double> array(5 * mesh.points.size(), 0.5);
         using Gaps = Eigen::Map<Eigen::Matrix2Xd, Eigen::Unaligned, Eigen::Stride<5, 2>>;
         smooth_in(
             array, mesh, options, xy, 2, [&](std::size_t v, std::size_t k) -> double& { return array[5 * v + 2 * k]; },
             [&]() -> PointView { return Gaps(array.data(), 2, static_cast<Eigen::Index>(mesh.points.size())); });
       }});
  return forms;
}

Mesh sample(double jitter = 0.45) {
  return test_meshes::shuffled(test_meshes::jittered_grid(9, 8, jitter, 3), 5);
}

TEST_CASE("points of double in every form of memory are smoothed to the same bits, and all else there is left alone") {
  const Mesh mesh = sample();
  const fakes::FakeBackend device;
  for (const bool on_device : {false, true}) {
    SmoothingOptions options;
    options.max_sweeps = 20;
    std::vector<double> expected = mesh.xy();
    plan(mesh.vertex_count(), mesh.indices(), {}, options).smooth(expected);
    REQUIRE(expected != mesh.xy());
    if (on_device) {
      options.backend = &device;
      options.topology = trismooth::Topology::device;
    }
    for (const Form& form : double_forms()) {
      CAPTURE(form.name, on_device);
      std::vector<double> found;
      form.smooth_as(mesh, options, found);
      CHECK(found == expected);
    }
  }
}

TEST_CASE("points of float are what a mesh is that is stored in float32, in every form of memory") {
  Mesh mesh = sample();
  for (auto& p : mesh.points) {
    p = {trismooth::rounded_to_float32(p.x), trismooth::rounded_to_float32(p.y)};
  }
  std::vector<double> expected = mesh.xy();
  plan(mesh.vertex_count(), mesh.indices()).smooth(expected, Storage::float32);
  std::vector<double> unrounded = mesh.xy();
  plan(mesh.vertex_count(), mesh.indices()).smooth(unrounded);
  REQUIRE(expected != unrounded);
  for (const Form& form : forms_of<float>()) {
    CAPTURE(form.name);
    std::vector<double> found;
    form.smooth_as(mesh, {}, found);
    CHECK(found == expected);
  }
  // Whatever a plan is asked to round to: there is room for no more.
  std::vector<float> floats(expected.size());
  const std::vector<double> xy = mesh.xy();
  std::ranges::transform(xy, floats.begin(), [](double x) { return static_cast<float>(x); });
  plan(mesh.vertex_count(), mesh.indices()).smooth(floats, Storage::float64);
  CHECK(std::vector<double>(floats.begin(), floats.end()) == expected);
}

TEST_CASE("where the device fails, points in every form of memory are what they were") {
  using fakes::Failure;
  const Mesh mesh = sample();
  for (const auto topology : {trismooth::Topology::host, trismooth::Topology::device}) {
    for (const Failure failure : {Failure::prepare, Failure::smooth, Failure::download}) {
      if (failure == Failure::download && topology == trismooth::Topology::host) {
        continue;  // the points are on the host in between
      }
      CAPTURE(static_cast<int>(failure));
      const fakes::FakeBackend device(failure);
      SmoothingOptions options;
      options.backend = &device;
      options.topology = topology;
      const auto require_untouched = [&](auto& memory, const auto& view) {
        const auto before = memory;  // NOLINT(performance-unnecessary-copy-initialization): the view is of the memory
        CHECK_THROWS_AS(smooth(view(), mesh.indices(), {}, options), trismooth::DeviceError);
        CHECK(memory == before);
      };
      std::vector<double> xy = mesh.xy();
      require_untouched(xy, [&] { return xy_points(xy); });
      std::vector<float> floats(xy.begin(), xy.end());
      require_untouched(floats, [&] { return xy_points(floats); });
      std::vector<std::array<double, 3>> triples;
      for (const auto& p : mesh.points) {
        triples.push_back({p.x, p.y, 3});
      }
      require_untouched(triples, [&]() -> PointView { return triples; });
    }
  }
}

TEST_CASE("by default a device without memory for the topology of a plan leaves it to the host, and says so") {
  const Mesh mesh = sample();
  const fakes::FakeBackend device(fakes::Failure::rings);
  std::vector<double> expected = mesh.xy();
  smooth(xy_points(expected), mesh.indices());
  SmoothingOptions options;
  options.backend = &device;
  std::vector<double> xy = mesh.xy();
  const trismooth::SmoothingResult result = smooth(xy_points(xy), mesh.indices(), {}, options);
  CHECK(xy == expected);
  CHECK(device.smoothed == 1);
  CHECK(result.backend_note.starts_with("the host found the neighbours: CUDA: cudaErrorMemoryAllocation"));
  options.topology = trismooth::Topology::device;
  CHECK_THROWS_AS(smooth(xy_points(xy), mesh.indices(), {}, options), trismooth::DeviceError);
}

TEST_CASE(
    "a plan whose device fails on the way back leaves the points, and smooths them when the device is well again") {
  const Mesh mesh = sample();
  fakes::FakeBackend device;
  SmoothingOptions options;
  options.backend = &device;
  options.topology = trismooth::Topology::device;
  auto on_device = trismooth::plan(mesh.vertex_count(), mesh.indices(), {}, options);
  std::vector<double> expected = mesh.xy();
  smooth(xy_points(expected), mesh.indices());
  for (const auto failure : {fakes::Failure::smooth, fakes::Failure::download, fakes::Failure::download}) {
    std::vector<double> xy = mesh.xy();
    device.fail_next_at(failure);
    CHECK_THROWS_AS(on_device.smooth(xy), trismooth::DeviceError);
    CHECK(xy == mesh.xy());
    device.fail_next_at(fakes::Failure::none);
    on_device.smooth(xy);
    CHECK(xy == expected);
  }
}

TEST_CASE("what is wrong with an argument is said in its own terms, and nothing is written") {
  const Mesh mesh = sample();
  const auto triangles = mesh.indices();
  std::vector<double> numbers(2 * mesh.points.size() + 1, 0.25);
  const std::vector<double> before = numbers;
  CHECK(refusal([&] { smooth(xy_points(numbers), triangles); }) ==
        "argument: points: 145 numbers, expected 2 for each point; xyz_points() is for x, y and z");
  CHECK(refusal([&] { smooth(xyz_points(numbers), triangles); }) ==
        "argument: points: 145 numbers, expected 3 for each point; xy_points() is for x and y alone");
  auto of_mesh = trismooth::plan(mesh.vertex_count(), triangles);
  std::vector<double> triples(3 * mesh.points.size(), 0.25);
  CHECK(refusal([&] { of_mesh.smooth(triples); }) ==
        "argument: points: 108 of them, expected one for each of 72 vertices; xyz_points() is for x, y and z");
  std::vector<std::array<float, 2>> few(7);
  CHECK(refusal([&] { of_mesh.smooth(few); }) == "argument: points: 7 of them, expected one for each of 72 vertices");
  // A point too few for the triangles is a mesh that is none.
  CHECK(refusal([&] { smooth(few, triangles); }).starts_with("mesh: triangle 0 names vertex "));
  double* const nothing = nullptr;
  CHECK(refusal([&] { smooth(xy_points(nothing, 5), triangles); }) == "argument: points: a null pointer for 5 points");
  CHECK(refusal([&] { smooth(xy_points(numbers.data(), 5, 12), triangles); }) ==
        "argument: points: a stride of 12 bytes for points of 16");
  CHECK(refusal([&] { smooth(xy_points(numbers.data(), 5, 20), triangles); }) ==
        "argument: points: numbers must lie at multiples of 8 bytes, their size");
  auto* const crooked = reinterpret_cast<double*>(reinterpret_cast<std::byte*>(numbers.data()) + 4);
  CHECK(refusal([&] { smooth(xy_points(crooked, 5), triangles); }) ==
        "argument: points: numbers must lie at multiples of 8 bytes, their size");
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(6, 4);
  CHECK(refusal([&] { smooth(trismooth::point_rows(wide), triangles); }) ==
        "argument: points: 4 numbers each, expected two (x, y) or three (x, y, z)");
  CHECK(numbers == before);
}

TEST_CASE("a third number is a height: the same everywhere, to 1e-6 of the extent, but for vertices that nobody uses") {
  const Mesh mesh = sample();
  const auto lifted = [&](double height_of_one, double scale) {
    std::vector<std::array<double, 3>> points;
    for (const auto& p : mesh.points) {
      points.push_back({p.x * scale, p.y * scale, 5});
    }
    points[11][2] += height_of_one;
    return points;
  };
  for (const double scale : {1.0, 1e-4, 1e150}) {
    auto flat = lifted(0.9e-6 * scale, scale);
    const auto before = flat;
    smooth(flat, mesh.indices());
    CHECK(flat != before);
    for (std::size_t v = 0; v < flat.size(); ++v) {
      CHECK(flat[v][2] == before[v][2]);
    }
    auto bent = lifted(1.1e-6 * scale + 1e-15, scale);
    const auto bent_before = bent;
    CHECK(refusal([&] { smooth(bent, mesh.indices()); }).starts_with("mesh: points: z runs from "));
    CHECK(bent == bent_before);
  }
  CHECK(
      refusal([&] {
        auto points = lifted(2.5, 1);
        smooth(points, mesh.indices());
      }) ==
      "mesh: points: z runs from 5 to 7.5, and must be the same everywhere to within 1e-6 of the mesh's extent; a mesh "
      "in a tilted plane is smoothed as a file, or by its coordinates in that plane");
  auto unknown = lifted(std::numeric_limits<double>::quiet_NaN(), 1);
  CHECK(refusal([&] { smooth(unknown, mesh.indices()); }) == "mesh: vertex 11 has a coordinate that is not finite");

  const fakes::FakeBackend device;
  for (const auto topology : {trismooth::Topology::host, trismooth::Topology::device}) {
    SmoothingOptions options;
    options.backend = &device;
    options.topology = topology;
    auto with_spare = lifted(0, 1);
    with_spare.push_back({0.5, 0.5, -1000});
    const auto before = with_spare;
    CHECK(smooth(with_spare, mesh.indices(), {}, options).moved_vertices > 0);
    CHECK(with_spare.back() == before.back());
    auto bent = lifted(0.5, 1);
    CHECK_THROWS_AS(smooth(bent, mesh.indices(), {}, options), MeshError);
  }
}

TEST_CASE("the first vertex with a coordinate that is not finite is named, however many threads look") {
  std::vector<std::array<float, 2>> points(100000, {1, 2});
  points[99999][0] = points[70001][1] = points[70002][0] = std::numeric_limits<float>::infinity();
  for (const int threads : {1, 2, 5}) {
    SmoothingOptions options;
    options.threads = threads;
    CHECK(refusal([&] { smooth(points, std::span<const int>{}, options); }) ==
          "mesh: vertex 70001 has a coordinate that is not finite");
  }
}

}  // namespace trismooth::point_view_test
