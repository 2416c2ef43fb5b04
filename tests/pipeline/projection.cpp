// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::projection_test {

struct Run {
  ScratchFolder folder;
  PipelineOptions options;

  explicit Run(const std::function<double(double, double)>& height, const std::string& extension = ".off") {
    const test_meshes::Mesh mesh = test_meshes::jittered_grid(20, 20, 0.3, 5);
    MeshDocument document = triangle_document(mesh);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      document.points[3 * v + 2] = height(mesh.points[v].x, mesh.points[v].y);
    }
    options.input = folder / ("in" + extension);
    options.output = folder / ("out" + extension);
    options.project = Projection::xy;
    write_mesh(options.input, document);
  }
  MeshDocument output() const { return read_mesh(*options.output); }
  MeshDocument input() const { return read_mesh(options.input); }
};

double hill(double x, double y) {
  return std::sin(3 * x) + y * y;
}

std::vector<double> coordinates(const MeshDocument& document, std::size_t axis) {
  std::vector<double> values;
  for (std::size_t i = axis; i < document.points.size(); i += 3) {
    values.push_back(document.points[i]);
  }
  return values;
}

TEST_CASE("a surface over x and y is smoothed as the flat mesh below it") {
  Run surface(hill);
  const PipelineResult result = run_pipeline(surface.options);
  Run flat([](double, double) { return 0.0; });
  flat.options.project.reset();
  const PipelineResult of_flat = run_pipeline(flat.options);
  CHECK(result.smoothing->moved_vertices > 200);
  CHECK(result.smoothing->moved_vertices == of_flat.smoothing->moved_vertices);
  CHECK(result.after->worst.front().shape == of_flat.after->worst.front().shape);
  for (const std::size_t axis : {0, 1}) {
    CHECK(coordinates(surface.output(), axis) == coordinates(flat.output(), axis));
  }
  CHECK(result.fields.size() == 1);
  CHECK(result.fields.front().name == "z");
}

TEST_CASE("z of vertices that moved is that of the surface that was read, and stays where fields are kept") {
  const auto slope = [](double x, double y) { return 2 * x - 3 * y + 1; };
  for (const char* const extension : {".off", ".vtk", ".ply", ".stl"}) {
    INFO(extension);
    Run run(slope, extension);
    run_pipeline(run.options);
    const MeshDocument written = run.output();
    for (std::size_t v = 0; v < written.point_count(); ++v) {
      const double expected = slope(written.points[3 * v], written.points[3 * v + 1]);
      CHECK(std::abs(written.points[3 * v + 2] - expected) < 1e-6);
    }
    CHECK(written.points != run.input().points);
    run.options.fields = Fields::keep;
    run_pipeline(run.options);
    CHECK(coordinates(run.output(), 2) == coordinates(run.input(), 2));
    CHECK(coordinates(run.output(), 0) == coordinates(written, 0));
  }
}

TEST_CASE("z that stands for none is never blended, and the vertices beside it are counted as those of fields are") {
  constexpr double none = -99999;
  Run run([](double x, double y) { return x > 0.4 && x < 0.5 && y > 0.4 && y < 0.6 ? none : hill(x, y); });
  const PipelineResult result = run_pipeline(run.options);
  const std::vector<double> before = coordinates(run.input(), 2);
  const std::vector<double> after = coordinates(run.output(), 2);
  REQUIRE(std::ranges::count(before, none) > 0);
  for (std::size_t v = 0; v < before.size(); ++v) {
    CHECK((before[v] == none ? after[v] == none : after[v] > -2));
  }
  REQUIRE(result.fields.size() == 1);
  const std::int64_t kept = result.smoothing->moved_vertices - result.fields[0].interpolated_vertices;
  CHECK(kept >= std::ranges::count(before, none));
  CHECK(std::ranges::any_of(result.notes, [kept](const std::string& note) {
    return note.starts_with(std::to_string(kept) + " vertices that moved stay as read in 'z'") &&
           note.ends_with("--fields keep");
  }));
}

TEST_CASE("without the option such a file is refused, and the message names it") {
  Run run(hill);
  run.options.project.reset();
  const std::string message = message_of<trismooth::ReadError>([&] { run_pipeline(run.options); });
  CHECK(message.find("not planar") != std::string::npos);
  CHECK(message.find("--project xy") != std::string::npos);
}

TEST_CASE("a mesh that is no function of x and y is warned of") {
  Run run([](double x, double y) { return x + y; });
  CHECK(run_pipeline(run.options).warnings == std::vector<std::string>{});
  MeshDocument document = run.input();
  document.points[3 * 150] += 0.3;  // over its neighbours
  write_mesh(run.options.input, document);
  const PipelineResult result = run_pipeline(run.options);
  CHECK(std::ranges::any_of(result.warnings, [](const std::string& warning) {
    return warning.find("--project xy: ") == 0 && warning.find("no function of x and y") != std::string::npos;
  }));
}

}  // namespace trismooth::projection_test
