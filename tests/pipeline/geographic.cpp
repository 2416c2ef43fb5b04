// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/space/mercator.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::PipelineOptions;
using trismooth::PipelineResult;
using trismooth::read_mesh;
using trismooth::run_pipeline;

namespace geographic_test {

double to_window(double longitude, double west) {
  return longitude - 360 * std::floor((longitude - west) / 360);
}

/// A mesh of `width` by `height` degrees; longitudes have few digits, so that turns round none of them.
MeshDocument patch(double west, double south, double width, double height, double window = -180) {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(25, 25, 0.35, 5);
  for (auto& [x, y] : mesh.points) {
    x = to_window(std::round((west + width * x) * 0x1p20) * 0x1p-20, window);
    y = south + height * y;
  }
  return triangle_document(mesh);
}

struct Run {
  ScratchFolder folder;
  PipelineOptions options;

  explicit Run(const MeshDocument& document, const std::string& extension = ".off") {
    options.input = folder / ("in" + extension);
    options.output = folder / ("out" + extension);
    options.geographic = true;
    write_mesh(options.input, document);
  }
  MeshDocument output() const { return read_mesh(*options.output); }
};

Eigen::Vector3d on_sphere(const MeshDocument& document, std::int32_t vertex) {
  constexpr double degree = std::numbers::pi / 180;
  const double longitude = document.points[3 * static_cast<std::size_t>(vertex)] * degree;
  const double latitude = document.points[3 * static_cast<std::size_t>(vertex) + 1] * degree;
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
}

/// The smallest and the mean of the triangles' smallest angles in space.
std::pair<double, double> angles(const MeshDocument& document) {
  double smallest = 180;
  double sum = 0;
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto triangle = document.cells[c];
    double own = 180;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d at = on_sphere(document, triangle[i]);
      const Eigen::Vector3d a = on_sphere(document, triangle[(i + 1) % 3]) - at;
      const Eigen::Vector3d b = on_sphere(document, triangle[(i + 2) % 3]) - at;
      own = std::min(own, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
    smallest = std::min(smallest, own);
    sum += own;
  }
  return {smallest, sum / static_cast<double>(document.cells.size())};
}

TEST_CASE("a mesh of the oceans' formats that looks like degrees gets a note without --geographic, and no other mesh") {
  const auto is_noted = [](const MeshDocument& document, const std::string& extension, bool geographic) {
    Run run(document, extension);
    run.options.geographic = geographic;
    const PipelineResult result = run_pipeline(run.options);
    return std::ranges::any_of(result.notes, [](const std::string& note) {
      return note.starts_with("x and y look like longitude and latitude in degrees: --geographic");
    });
  };
  const MeshDocument degrees = patch(10, 50, 12, 6);
  for (const char* const extension : {".14", ".gr3", ".2dm"}) {
    CAPTURE(extension);
    CHECK(is_noted(degrees, extension, false));
    CHECK_FALSE(is_noted(degrees, extension, true));
    // A bay, to the east and to the west.
    CHECK(is_noted(patch(10, 58, 1, 0.4), extension, false));
    CHECK(is_noted(patch(-71, 41, 0.5, 0.5), extension, false));
    // A basin of some metres, and one of kilometres.
    CHECK_FALSE(is_noted(patch(0, 0, 2, 1), extension, false));
    MeshDocument kilometres = degrees;
    for (double& coordinate : kilometres.points) {
      coordinate *= 1000;
    }
    CHECK_FALSE(is_noted(kilometres, extension, false));
    // Flumes and basins of 20 m, from the axes on or in the middle of them, and a model of a few millimetres.
    CHECK_FALSE(is_noted(patch(0, 0, 20, 20), extension, false));
    CHECK_FALSE(is_noted(patch(-10, 0, 20, 12), extension, false));
    CHECK_FALSE(is_noted(patch(-3, -0.5, 20, 1), extension, false));
    CHECK_FALSE(is_noted(patch(50, 50, 2e-5, 1e-5), extension, false));
  }
  CHECK_FALSE(is_noted(degrees, ".off", false));
}

TEST_CASE("angles that reports have are those on the sphere, and are better than without the map") {
  Run run(patch(10, 60, 12, 6));
  const PipelineResult result = run_pipeline(run.options);
  const auto [smallest, mean] = angles(run.output());
  CHECK((*result.after)[trismooth::Metric::min_angle].min == Approx(smallest).margin(0.2));
  CHECK((*result.after)[trismooth::Metric::min_angle].mean == Approx(mean).margin(0.1));
  const auto [smallest_before, mean_before] = angles(read_mesh(run.options.input));
  CHECK(result.before[trismooth::Metric::min_angle].min == Approx(smallest_before).margin(0.2));
  CHECK(smallest > smallest_before);
  run.options.geographic = false;
  run_pipeline(run.options);
  CHECK(mean > angles(run.output()).second + 0.3);
}

TEST_CASE("a mesh across the date line is smoothed as the same mesh elsewhere is") {
  for (const double window : {-180.0, 0.0}) {
    const double seam = window == 0 ? 345 : 165;
    const Run across(patch(seam, 40, 30, 20, window));
    const Run elsewhere(patch(seam - 90, 40, 30, 20, window));
    const PipelineResult result = run_pipeline(across.options);
    const PipelineResult other = run_pipeline(elsewhere.options);
    CHECK(result.before.worst.front().shape == other.before.worst.front().shape);
    CHECK(result.smoothing->sweeps == other.smoothing->sweeps);
    CHECK(result.smoothing->moved_vertices == other.smoothing->moved_vertices);
    CHECK(result.smoothing->reverted_vertices == other.smoothing->reverted_vertices);
    CHECK(result.smoothing->moved_vertices > 400);
    CHECK(result.notes.empty());
    const MeshDocument a = across.output();
    const MeshDocument b = elsewhere.output();
    INFO(window);
    for (std::size_t v = 0; v < a.point_count(); ++v) {
      CHECK(a.points[3 * v] >= window);
      CHECK(a.points[3 * v] < window + 360);
      const double difference = a.points[3 * v] - b.points[3 * v] - 90;
      CHECK(std::abs(difference - 360 * std::round(difference / 360)) < 1e-9);
      CHECK(std::abs(a.points[3 * v + 1] - b.points[3 * v + 1]) < 1e-9);
    }
  }
}

TEST_CASE("what does not move keeps its bits, and nothing gets worse as it is stored") {
  MeshDocument document = patch(-75, 38, 0.5, 0.4);
  document.point_type = trismooth::ScalarType::float32;
  for (double& coordinate : document.points) {
    coordinate = static_cast<double>(static_cast<float>(coordinate));
  }
  Run run(document, ".ply");
  const PipelineResult result = run_pipeline(run.options);
  CHECK(result.after->worst.front().shape >= result.before.worst.front().shape);
  CHECK(result.after->inverted <= result.before.inverted);
  const MeshDocument written = run.output();
  std::int64_t others = 0;
  for (std::size_t v = 0; v < written.point_count(); ++v) {
    others += std::equal(&written.points[3 * v], &written.points[3 * v] + 3, &document.points[3 * v]) ? 0 : 1;
  }
  CHECK(others == result.smoothing->moved_vertices);
  const std::string one = bytes_of(*run.options.output);
  run.options.smoothing.threads = 3;
  run_pipeline(run.options);
  CHECK(bytes_of(*run.options.output) == one);
}

TEST_CASE("fields are interpolated on the map") {
  MeshDocument document = patch(170, 50, 20, 20);
  std::vector<double> field;
  const auto linear = [](double longitude, double latitude) {
    return to_window(longitude, 0) + 2 * trismooth::mercator_of_latitude(latitude);
  };
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    field.push_back(linear(document.points[3 * v], document.points[3 * v + 1]));
  }
  document.point_arrays = {make_data_array("f", 1, field)};
  Run run(document, ".vtk");
  run.options.fields = trismooth::Fields::interpolate;
  run_pipeline(run.options);
  const MeshDocument written = run.output();
  for (std::size_t v = 0; v < written.point_count(); ++v) {
    CHECK(written.point_arrays[0].value(v) ==
          Approx(linear(written.points[3 * v], written.points[3 * v + 1])).epsilon(1e-12));
  }
}

TEST_CASE("a mesh round the globe keeps the triangles of its seam") {
  MeshDocument document;
  constexpr std::int32_t columns = 36;
  constexpr std::int32_t rows = 9;
  test_meshes::Random dice(3);
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      document.points.insert(document.points.end(), {-180 + 10.0 * column + (column > 0 ? dice.between(-3, 3) : 0),
                                                     -40 + 10.0 * row + dice.between(-3, 3), 0});
    }
  }
  for (std::int32_t row = 0; row + 1 < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      const std::int32_t a = row * columns + column;
      const std::int32_t b = row * columns + (column + 1) % columns;
      document.cells.append(trismooth::cell_type::triangle, std::array{a, b, b + columns});
      document.cells.append(trismooth::cell_type::triangle, std::array{a, b + columns, a + columns});
    }
  }
  Run run(document);
  const PipelineResult result = run_pipeline(run.options);
  CHECK(result.input.triangles == 2 * (rows - 1) * (columns - 1));
  CHECK(result.notes ==
        std::vector<std::string>{"the mesh goes round the globe: 16 triangles across its seam are kept as they are, "
                                 "their vertices held fixed"});
  const MeshDocument written = run.output();
  CHECK(written.cells.size() == document.cells.size());
  CHECK(result.smoothing->moved_vertices > 200);
  for (std::size_t row = 0; row < rows; ++row) {
    for (const std::size_t column : {0, columns - 1}) {
      const std::size_t v = row * columns + column;
      CHECK(written.points[3 * v] == document.points[3 * v]);
    }
  }
}

TEST_CASE("poles and what are no degrees are refused, and so is what the map cannot hold") {
  const auto message = [](const std::function<void(MeshDocument&)>& change) {
    MeshDocument document = patch(0, 0, 10, 10);
    change(document);
    const Run run(document);
    return message_of<trismooth::ReadError>([&] { run_pipeline(run.options); });
  };
  CHECK(message([](MeshDocument& document) {
          document.points[1] = -90;
        }).ends_with("vertex 0 is at a pole, which has no place on the map of --geographic"));
  CHECK(message([](MeshDocument& document) { document.points[4] = 95; }).find("no longitude and latitude in degrees") !=
        std::string::npos);
  CHECK(message([](MeshDocument& document) {
          for (std::size_t v = 0; v < document.point_count(); ++v) {
            std::swap(document.points[3 * v + 1], document.points[3 * v + 2]);
          }
        }).find("does not lie in the plane of x and y") != std::string::npos);
  Run run(patch(0, 0, 10, 10));
  run.options.smoothing.method = trismooth::Method::mean_ratio;
  run.options.size_array = "h";
  CHECK(message_of<std::invalid_argument>([&] { run_pipeline(run.options); }).starts_with("--size-array"));
}

}  // namespace geographic_test
