// SPDX-License-Identifier: BSD-3-Clause
// What the mean-ratio method promises of the elements, beside the paper's rule, with the defaults of both.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/input/fixed_array.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/distorted_meshes.h"
#include "support/naive_mean_ratio.h"
#include "support/naive_smoothing.h"

namespace trismooth::mean_ratio_quality_test {

struct Input {
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> fixed{};
  std::vector<std::uint8_t> other_cells{};
  std::vector<std::int32_t> regions{};
};

/// The mesh of a file, with what `trismooth smooth` would hold fixed in it.
Input example(const std::string& name) {
  const auto path = std::filesystem::path(TRISMOOTH_EXAMPLE_DATA) / name;
  const trismooth::MeshDocument document = trismooth::read_mesh(path);
  trismooth::PlanarMesh mesh = trismooth::planar_mesh(document, path);
  Input input;
  input.fixed = trismooth::find_fixed_array(document, std::nullopt).flags;
  input.regions = trismooth::find_regions(document, mesh).of_triangle;
  input.other_cells = std::move(mesh.in_other_cell);
  input.points.assign(mesh.points.begin(), mesh.points.end());
  input.triangles.assign(mesh.elements.triangles().begin(), mesh.elements.triangles().end());
  return input;
}

Input random_mesh(std::int64_t vertices, std::uint64_t seed, trismooth::GeneratedBoundary boundary) {
  trismooth::RandomMeshOptions options;
  options.boundary = boundary;
  trismooth::RandomMesh mesh = trismooth::random_delaunay_mesh(vertices, seed, options);
  return {std::move(mesh.points), std::move(mesh.triangles)};
}

/// After smoothing with the defaults.
std::vector<Point2<double>> smoothed(const Input& input, Method method,
                                     Precision precision = Precision::double_precision) {
  std::vector<double> xy;
  for (const Point2<double> p : input.points) {
    xy.insert(xy.end(), {p.x, p.y});
  }
  trismooth::SmoothingOptions options;
  options.method = method;
  options.precision = precision;
  options.threads = 1;
  trismooth::smooth(trismooth::xy_points(xy), input.triangles,
                    {.fixed = input.fixed, .other_cells = input.other_cells, .regions = input.regions}, options);
  std::vector<Point2<double>> points;
  for (std::size_t i = 0; i < xy.size(); i += 2) {
    points.push_back({xy[i], xy[i + 1]});
  }
  return points;
}

struct Shapes {
  double smallest;
  double first_percentile;
  double mean;
};

Shapes shapes(const Input& input, const std::vector<Point2<double>>& points) {
  std::vector<double> values;
  double sum = 0;
  for (const Triangle& t : input.triangles) {
    const double shape = trismooth::shape(points[t[0]], points[t[1]], points[t[2]]);
    values.push_back(shape);
    sum += shape;
  }
  // In files triangles may be listed clockwise, all of them.
  if (sum < 0) {
    sum = -sum;
    std::ranges::transform(values, values.begin(), [](double x) { return -x; });
  }
  std::ranges::sort(values);
  return {values.front(), values[values.size() / 100], sum / static_cast<double>(values.size())};
}

/// Each of the three is larger by so much.
void check_larger(const Shapes& found, const Shapes& than, const Shapes& by) {
  CHECK(found.smallest > than.smallest + by.smallest);
  CHECK(found.first_percentile > than.first_percentile + by.first_percentile);
  CHECK(found.mean > than.mean + by.mean);
}

TEST_CASE("random meshes whose boundary is resolved get better elements from mean-ratio than from smart") {
  for (const std::int64_t vertices : {1000, 5000}) {
    for (const std::uint64_t seed : {1, 2}) {
      CAPTURE(vertices, seed);
      const Input input = random_mesh(vertices, seed, trismooth::GeneratedBoundary::resolved);
      const Shapes smart = shapes(input, smoothed(input, Method::smart));
      for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        const Shapes found = shapes(input, smoothed(input, Method::mean_ratio, precision));
        check_larger(found, smart, {0.05, 0.04, 0.01});
        CHECK(found.smallest > 0.4);
        CHECK(found.first_percentile > 0.58);
        CHECK(found.mean > 0.895);
      }
    }
  }
}

TEST_CASE("the meshes of the examples get no worse elements from mean-ratio than from smart") {
  for (const std::string name : {"coast.vtu", "farfield.vtk", "machine.vtu", "plate.off"}) {
    CAPTURE(name);
    const Input input = example(name);
    const Shapes smart = shapes(input, smoothed(input, Method::smart));
    check_larger(shapes(input, smoothed(input, Method::mean_ratio)), smart, {-0.002, -0.002, -0.002});
  }
}

TEST_CASE("a wave-shaped grid gets better elements from mean-ratio than from smart") {
  test_meshes::Mesh mesh = distorted_meshes::wave(40);
  const Input input{mesh.points, mesh.triangles};
  check_larger(shapes(input, smoothed(input, Method::mean_ratio)), shapes(input, smoothed(input, Method::smart)),
               {0.15, 0.1, 0.01});
}

TEST_CASE("no triangle's share of the error, area times squared edges, grows beyond what the bounds allow") {
  // Where the boundary is coarse elements would grow to its edges. A triangle may have the largest share that there was
  // around one of its free vertices, or that of an equilateral one 1.5 / trust times as large as the mean area there.
  for (const std::uint64_t seed : {1, 2, 3}) {
    CAPTURE(seed);
    const Input input = random_mesh(2000, seed, trismooth::GeneratedBoundary::random);
    const auto frame = trismooth::local_frame(input.points);
    std::vector<Point2<double>> before;
    for (const auto p : input.points) {
      before.push_back(frame.enter(p));
    }
    const auto rings = naive::one_rings(static_cast<std::int32_t>(before.size()), input.triangles);
    const auto aims = naive::mean_ratio_aims(before, rings, {});
    double largest_before = 0;
    double largest_after = 0;
    double largest_of_plain = 0;
    const std::vector<Point2<double>> after = smoothed(input, Method::mean_ratio);
    const std::vector<Point2<double>> plain = smoothed(input, Method::laplacian);
    for (const Triangle& t : input.triangles) {
      const auto share = [&](const std::vector<Point2<double>>& points) {
        const auto at = [&](int i) { return naive::widened(frame.enter(points[static_cast<std::size_t>(t[i])])); };
        return static_cast<double>(naive::share(at(0), at(1), at(2)));
      };
      double bound = share(input.points);
      bool is_free = false;
      for (const std::int32_t v : t) {
        is_free = is_free || !rings[v].empty();
        bound = rings[v].empty() ? bound : std::max(bound, aims.largest_shares[v]);
      }
      if (is_free) {
        REQUIRE(share(after) <= bound * (1 + 1e-12));
        largest_before = std::max(largest_before, share(input.points));
        largest_after = std::max(largest_after, share(after));
        largest_of_plain = std::max(largest_of_plain, share(plain));
      }
    }
    // That is: no share of a mesh becomes more than a few times the largest there was, as by plain averages.
    CHECK(largest_after <= 2 * largest_before);
    CHECK(largest_of_plain > 4 * largest_after);
  }
}

}  // namespace trismooth::mean_ratio_quality_test
