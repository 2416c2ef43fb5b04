// SPDX-License-Identifier: BSD-3-Clause
// Meshes of about N vertices for the comparison of finite element solutions (finite_elements.py). In the unit square:
//   hexagonal        Delaunay mesh of hexagonal points, each displaced at random
//   displaced        a grid displaced by up to 45 % of its spacing in x and in y: some triangles are inverted
// In the square [-1, 1]^2 with a round hole of radius 0.25 in the middle:
//   plate-random     Delaunay mesh of random points
//   plate-hexagonal  Delaunay mesh of hexagonal points as above
//   plate-displaced  a grid around the hole, graded towards it, displaced as above
// The points on the boundary are as far apart as those inside, and stay where they are. Random meshes of the unit
// square come from `trismooth generate`. Usage: finite_element_meshes KIND N SEED OUTPUT

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/generate/delaunay.h"

namespace {

using trismooth::Point2;

struct Mesh {
  std::vector<Point2<double>> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The same numbers on every platform, unlike those of the standard's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double between(double lowest, double highest) {
    return lowest + (highest - lowest) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 generator_;
};

/// The square [lowest, 1]^2, with a hole around its centre where `hole` is not 0.
struct Domain {
  double lowest = 0;
  double hole = 0;

  double side() const { return 1 - lowest; }
  double centre() const { return (1 + lowest) / 2; }
  double area() const { return side() * side() - std::numbers::pi * hole * hole; }
  /// How far a point is inside.
  double depth(Point2<double> p) const {
    const double from_sides = std::min({p.x - lowest, 1 - p.x, p.y - lowest, 1 - p.y});
    return hole == 0 ? from_sides : std::min(from_sides, std::hypot(p.x - centre(), p.y - centre()) - hole);
  }
};

std::vector<Point2<double>> boundary_points(const Domain& domain, double spacing) {
  std::vector<Point2<double>> points;
  const auto per_side = std::lround(domain.side() / spacing);
  for (int i = 0; i < per_side; ++i) {
    const double t = domain.side() * i / static_cast<double>(per_side);
    points.insert(points.end(),
                  {{domain.lowest + t, domain.lowest}, {1, domain.lowest + t}, {1 - t, 1}, {domain.lowest, 1 - t}});
  }
  const auto on_rim = std::lround(2 * std::numbers::pi * domain.hole / spacing);
  for (int i = 0; i < on_rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / static_cast<double>(on_rim);
    points.push_back(
        {domain.centre() + domain.hole * std::cos(angle), domain.centre() + domain.hole * std::sin(angle)});
  }
  return points;
}

/// The Delaunay mesh of the points, of which the first `boundary` lie on the boundary. Triangles in the hole are left
/// out: their corners all lie on its rim, and on one circle that is empty, so that the rim's edges are the mesh's.
Mesh delaunay_mesh(const Domain& domain, std::vector<Point2<double>> points, std::size_t boundary) {
  constexpr std::int32_t steps = 1 << (trismooth::grid_bits - 1);
  std::vector<trismooth::GridPoint> grid;
  for (const Point2<double> p : points) {
    grid.push_back({static_cast<std::int32_t>(std::lround((p.x - domain.lowest) / domain.side() * steps)),
                    static_cast<std::int32_t>(std::lround((p.y - domain.lowest) / domain.side() * steps))});
  }
  Mesh mesh{std::move(points), trismooth::delaunay(grid)};
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t v) {
      return static_cast<std::size_t>(v) < boundary &&
             std::hypot(mesh.points[v].x - domain.centre(), mesh.points[v].y - domain.centre()) < 1.001 * domain.hole;
    });
  });
  return mesh;
}

/// Random points inside, none nearer to the boundary than a fifth of the spacing.
Mesh random_mesh(const Domain& domain, int vertices, Random& random) {
  const double spacing = std::sqrt(domain.area() / vertices);
  std::vector<Point2<double>> points = boundary_points(domain, spacing);
  const std::size_t boundary = points.size();
  while (points.size() < static_cast<std::size_t>(vertices)) {
    const Point2<double> p{random.between(domain.lowest, 1), random.between(domain.lowest, 1)};
    if (domain.depth(p) > 0.2 * spacing) {
      points.push_back(p);
    }
  }
  return delaunay_mesh(domain, std::move(points), boundary);
}

/// Hexagonal points inside, displaced by up to 0.4 of their spacing in x and in y.
Mesh hexagonal_mesh(const Domain& domain, int vertices, Random& random) {
  const double spacing = std::sqrt(domain.area() / vertices * 2 / std::numbers::sqrt3);
  std::vector<Point2<double>> points = boundary_points(domain, spacing);
  const std::size_t boundary = points.size();
  const double height = spacing * std::numbers::sqrt3 / 2;
  for (int row = 1; row * height < domain.side(); ++row) {
    for (int column = 0; column * spacing < domain.side(); ++column) {
      const Point2<double> place{domain.lowest + (column + row % 2 * 0.5) * spacing, domain.lowest + row * height};
      const Point2<double> p{place.x + 0.4 * spacing * random.between(-1, 1),
                             place.y + 0.4 * spacing * random.between(-1, 1)};
      if (domain.depth(place) > 0.5 * spacing && domain.depth(p) > 0.2 * spacing) {
        points.push_back(p);
      }
    }
  }
  return delaunay_mesh(domain, std::move(points), boundary);
}

/// A grid of columns x rows places, displaced inside by up to 45 % of its spacing; `place` maps (column, row) to the
/// plane. Where it closes, the last column is the first.
template <class Place>
Mesh displaced_grid(int columns, int rows, bool closes, Random& random, const Place& place) {
  Mesh mesh;
  const int width = closes ? columns : columns + 1;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column < width; ++column) {
      const bool inside = row > 0 && row < rows && (closes || (column > 0 && column < columns));
      const double by_column = inside ? 0.45 * random.between(-1, 1) : 0;
      const double by_row = inside ? 0.45 * random.between(-1, 1) : 0;
      mesh.points.push_back(place(column + by_column, row + by_row));
      if (row < rows && column < columns) {
        const std::int32_t a = row * width + column;
        const std::int32_t b = row * width + (column + 1) % width;
        mesh.triangles.push_back({a, b, b + width});
        mesh.triangles.push_back({a, b + width, a + width});
      }
    }
  }
  return mesh;
}

Mesh displaced_square(int vertices, Random& random) {
  const auto n = static_cast<int>(std::lround(std::sqrt(vertices)) - 1);
  return displaced_grid(n, n, false, random, [&](double column, double row) {
    return Point2<double>{column / n, row / n};
  });
}

/// Columns run around the hole, rows from the square's sides to the rim; triangles near the rim are smaller by far.
Mesh displaced_plate(const Domain& domain, int vertices, Random& random) {
  const int rows = std::max(2, static_cast<int>(std::lround(std::sqrt(0.22 * vertices))));
  const int columns = (vertices / rows + 7) / 8 * 8;  // so that the corners are among the points
  return displaced_grid(columns, rows, true, random, [&](double column, double row) {
    const double angle = 2 * std::numbers::pi * column / columns;
    const double to_side = 1 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    const double distance = to_side * std::pow(domain.hole / to_side, row / rows);
    return Point2<double>{distance * std::cos(angle), distance * std::sin(angle)};
  });
}

Mesh make_mesh(const std::string& kind, int vertices, Random& random) {
  const Domain square;
  const Domain plate{-1, 0.25};
  if (kind == "hexagonal") {
    return hexagonal_mesh(square, vertices, random);
  }
  if (kind == "displaced") {
    return displaced_square(vertices, random);
  }
  if (kind == "plate-random") {
    return random_mesh(plate, vertices, random);
  }
  if (kind == "plate-hexagonal") {
    return hexagonal_mesh(plate, vertices, random);
  }
  if (kind == "plate-displaced") {
    return displaced_plate(plate, vertices, random);
  }
  throw std::invalid_argument("unknown kind '" + kind + "'");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: finite_element_meshes KIND N SEED OUTPUT\n", stderr);
    return 2;
  }
  try {
    Random random(std::stoull(argv[3]));
    const Mesh mesh = make_mesh(argv[1], std::stoi(argv[2]), random);
    trismooth::MeshDocument document;
    for (const Point2<double> point : mesh.points) {
      document.points.insert(document.points.end(), {point.x, point.y, 0});
    }
    for (const auto& triangle : mesh.triangles) {
      document.cells.append(trismooth::cell_type::triangle, triangle);
    }
    trismooth::write_mesh(argv[4], document);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "finite_element_meshes: %s\n", error.what());
    return 1;
  }
}
