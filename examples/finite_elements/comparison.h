// SPDX-License-Identifier: BSD-3-Clause
// A mesh from a file, smoothed by several methods, and a problem solved on each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

#include "linear_triangles.h"

namespace fem {

/// A problem's errors against its exact solution, and the iterations that it took.
struct Outcome {
  Solution solution;
  double value_error = 0;     ///< of the solution itself (L2 norm)
  double gradient_error = 0;  ///< of its derivatives
};

using Problem = std::function<Outcome(const Mesh&)>;

/// The triangles of a file that lies in the plane of x and y; its cell array `region`, where there is one, names
/// regions.
inline Mesh read(const std::string& path) {
  const trismooth::MeshDocument document = trismooth::read_mesh(path);
  const trismooth::DataArray* const region = trismooth::find_array(document.cell_arrays, "region");
  Mesh mesh;
  std::vector<int> corners;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    const auto vertices = document.cells[cell];
    if (vertices.size() > 3) {
      throw std::runtime_error(path + ": has a cell that is not a triangle");
    }
    if (vertices.size() == 3) {  // fewer: points and lines that mark something
      corners.insert(corners.end(), vertices.begin(), vertices.end());
      if (region != nullptr) {
        mesh.regions.push_back(static_cast<std::int32_t>(region->value(cell)));
      }
    }
  }
  if (corners.empty()) {
    throw std::runtime_error(path + ": has no triangles");
  }

  // Some files hold points that no triangle uses. They have no equation, and are left out.
  std::vector<int> number(document.point_count(), -1);
  for (const int corner : corners) {
    number[corner] = 0;
  }
  int used = 0;
  mesh.points.resize(2, std::count(number.begin(), number.end(), 0));
  for (std::size_t point = 0; point < number.size(); ++point) {
    if (number[point] == 0) {
      if (document.points[3 * point + 2] != document.points[3 * corners.front() + 2]) {
        throw std::runtime_error(path + ": does not lie in the plane of x and y");
      }
      mesh.points.col(used) << document.points[3 * point], document.points[3 * point + 1];
      number[point] = used++;
    }
  }
  std::transform(corners.begin(), corners.end(), corners.begin(), [&](int corner) { return number[corner]; });
  mesh.triangles = Eigen::Matrix3Xi::Map(corners.data(), 3, static_cast<Eigen::Index>(corners.size() / 3));
  return mesh;
}

/// Smooths the points in place: this is all that a program has to say to the library.
inline trismooth::SmoothingResult smooth(Mesh& mesh, trismooth::Method method) {
  trismooth::Constraints constraints;
  constraints.regions = mesh.regions;  // vertices between two regions stay, as those on the boundary do
  trismooth::SmoothingOptions options;
  options.method = method;
  return trismooth::smooth(mesh.points, mesh.triangles, constraints, options);
}

/// A line of the table.
struct Row {
  std::string name;
  std::int64_t sweeps = 0;
  trismooth::QualityReport quality;
  std::optional<Outcome> outcome;  ///< none where triangles are inverted or degenerate: there is no solution
};

inline Row row(std::string name, const Mesh& mesh, std::int64_t sweeps, const Problem& problem) {
  Row made{std::move(name), sweeps, trismooth::quality(mesh.points, mesh.triangles), std::nullopt};
  if (made.quality.inverted + made.quality.degenerate == 0) {
    made.outcome = problem(mesh);
  }
  return made;
}

/// A row for the mesh as it is and one for each method, for every method of the library where none is named.
inline std::vector<Row> compare(const Mesh& mesh, std::vector<std::string> methods, const Problem& problem) {
  if (methods.empty()) {
    for (const auto& [method, name] : trismooth::EnumText<trismooth::Method>::texts) {
      methods.emplace_back(name);
    }
  }
  std::vector<Row> rows{row("before", mesh, 0, problem)};
  for (const std::string& name : methods) {
    Mesh smoothed = mesh;
    const trismooth::SmoothingResult result = smooth(smoothed, trismooth::parse_enum<trismooth::Method>(name));
    rows.push_back(row(name, smoothed, result.sweeps, problem));
  }
  return rows;
}

inline void print(const std::vector<Row>& rows) {
  std::printf("%-12s %6s %9s %7s %9s %6s %7s %11s %14s\n", "method", "sweeps", "min_shape", "mean", "max_area", "cg",
              "jacobi", "value_error", "gradient_error");
  for (const Row& made : rows) {
    const trismooth::MetricSummary& shape = made.quality[trismooth::Metric::shape];
    std::printf("%-12s %6lld %9.4f %7.4f %9.2e", made.name.c_str(), static_cast<long long>(made.sweeps), shape.min,
                shape.mean, made.quality[trismooth::Metric::area].max);
    if (made.outcome) {
      std::printf(" %6lld %7lld %11.2e %14.3e\n", static_cast<long long>(made.outcome->solution.plain),
                  static_cast<long long>(made.outcome->solution.jacobi), made.outcome->value_error,
                  made.outcome->gradient_error);
    } else {
      std::printf("  no solution: %lld triangles are inverted or degenerate\n",
                  static_cast<long long>(made.quality.inverted) + made.quality.degenerate);
    }
  }
}

}  // namespace fem
