#include "trismooth/pipeline/pipeline.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/held_text.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"

using trismooth::PipelineOptions;
using trismooth::PipelineResult;

namespace {

/// A mesh in a file, and a place for the output, for as long as the test lasts.
class Files {
 public:
  explicit Files(const test_meshes::Mesh& mesh) {
    std::ofstream file(folder_ / "in.off");
    file << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n" << std::setprecision(17);
    for (const auto& [x, y] : mesh.points) {
      file << x << ' ' << y << " 0\n";
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      file << "3 " << a << ' ' << b << ' ' << c << '\n';
    }
  }

  PipelineOptions options() const {
    PipelineOptions options;
    options.input = folder_ / "in.off";
    options.output = folder_ / "out.off";
    return options;
  }
  std::string output() const { return bytes_of(folder_ / "out.off"); }

 private:
  ScratchFolder folder_;
};

/// A mesh with much that topology has to find: two components of opposite orientation, an edge with three triangles,
/// a bow tie, an isolated vertex.
test_meshes::Mesh irregular_mesh() {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(14, 11, 0.45, 5);
  const auto second = static_cast<std::int32_t>(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 5) {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  const test_meshes::Mesh other = test_meshes::jittered_grid(9, 9, 0.4, 6);
  for (const auto& [x, y] : other.points) {
    mesh.points.push_back({x + 2, y});
  }
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + second, c + second, b + second});
  }
  const auto next = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{0.5, 2}, {-1, -1}, {-1, 0}, {7, 7}});
  mesh.triangles.push_back({50, 51, next});
  mesh.triangles.push_back({0, next + 2, next + 1});
  return mesh;
}

}  // namespace

TEST_CASE("with --topology device the backend finds the rings, and the file is the same to the byte") {
  const Files files(irregular_mesh());
  PipelineOptions options = files.options();
  const PipelineResult expected = trismooth::run_pipeline(options);
  const std::string expected_output = files.output();
  REQUIRE(expected.input.components >= 2);
  REQUIRE(expected.input.reoriented_triangles > 0);
  REQUIRE(expected.notes.size() == 2);

  const fakes::FakeBackend device;
  options.smoothing.backend = &device;
  trismooth::run_pipeline(options);
  CHECK(device.rings_found == 0);
  options.smoothing.topology = trismooth::Topology::device;
  const PipelineResult found = trismooth::run_pipeline(options);
  CHECK(device.rings_found == 1);
  CHECK(found.coordinates_hash == expected.coordinates_hash);
  CHECK(files.output() == expected_output);
  CHECK(found.notes == expected.notes);
  CHECK(found.input.components == expected.input.components);
  CHECK(found.input.free_vertices == expected.input.free_vertices);
  CHECK(found.input.fixed_vertices == expected.input.fixed_vertices);
  CHECK(held_text(found.input) == held_text(expected.input));
  CHECK(expected.input.held.boundary > 0);
  CHECK(expected.input.held.non_manifold > 0);
  CHECK(expected.input.held.bow_tie > 0);
  CHECK(expected.input.held.unused == 1);
  CHECK(found.input.reoriented_triangles == expected.input.reoriented_triangles);
  CHECK(found.after->metrics[0].min == expected.after->metrics[0].min);
}

TEST_CASE("a backend that leaves the topology to the host gets the halfedge mesh's rings") {
  const Files files(irregular_mesh());
  PipelineOptions options = files.options();
  const PipelineResult expected = trismooth::run_pipeline(options);
  options.smoothing.topology = trismooth::Topology::device;  // the CPU's finds none
  CHECK(trismooth::run_pipeline(options).coordinates_hash == expected.coordinates_hash);
}

TEST_CASE("a mesh of triangle strips is smoothed to the bits of its triangles, and its strips stay") {
  // A grid whose rows are strips, as a program for graphics writes them: points of two rows in turn.
  constexpr std::int32_t n = 12;
  const test_meshes::Mesh grid = test_meshes::jittered_grid(n + 1, n + 1, 0.4, 7);
  const auto at = [](std::int32_t row, std::int32_t column) { return row * (n + 1) + column; };
  std::string points;
  for (const auto& [x, y] : grid.points) {
    points += fmt::format("{} {} 0\n", x, y);
  }
  std::string strips;
  std::string triangles;
  for (std::int32_t row = 0; row < n; ++row) {
    strips += std::to_string(2 * (n + 1));
    for (std::int32_t column = 0; column <= n; ++column) {
      strips += fmt::format(" {} {}", at(row + 1, column), at(row, column));
      if (column < n) {
        triangles += fmt::format("3 {} {} {}\n", at(row + 1, column), at(row, column), at(row + 1, column + 1));
        triangles += fmt::format("3 {} {} {}\n", at(row + 1, column + 1), at(row, column), at(row, column + 1));
      }
    }
    strips += '\n';
  }
  const std::string head = fmt::format("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS {} double\n{}",
                                       grid.points.size(), points);
  const std::string strips_head = fmt::format("TRIANGLE_STRIPS {} {}\n", n, n * (2 * n + 3));
  const ScratchFolder folder;
  PipelineOptions options;
  options.annotate = true;
  options.input =
      folder.write("triangles.vtk", head + fmt::format("POLYGONS {} {}\n{}", 2 * n * n, 8 * n * n, triangles));
  options.output = folder / "triangles_out.vtk";
  const PipelineResult expected = trismooth::run_pipeline(options);
  options.input = folder.write("strips.vtk", head + strips_head + strips);
  options.output = folder / "strips_out.vtk";
  const PipelineResult result = trismooth::run_pipeline(options);
  CHECK(result.input.triangles == 2 * n * n);
  CHECK(result.input.other_cells == 0);
  CHECK(result.smoothing->moved_vertices > 0);
  CHECK(result.coordinates_hash == expected.coordinates_hash);
  CHECK(bytes_of(*options.output).find(strips_head + strips) != std::string::npos);
  // A strip is as good as the worst of its triangles: two of them for each of n columns.
  const auto shapes = [](const std::filesystem::path& path) {
    const trismooth::MeshDocument document = trismooth::read_mesh(path);
    const trismooth::DataArray* const array = find_array(document.cell_arrays, "shape");
    REQUIRE(array != nullptr);
    const auto values = array->as<double>();
    return std::vector<double>(values.begin(), values.end());
  };
  const std::vector<double> of_triangles = shapes(folder / "triangles_out.vtk");
  const std::vector<double> of_strips = shapes(folder / "strips_out.vtk");
  REQUIRE(of_strips.size() == n);
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto first = of_triangles.begin() + 2 * n * row;
    CHECK(of_strips[static_cast<std::size_t>(row)] == *std::min_element(first, first + 2 * n));
  }
}

TEST_CASE("triangles that are no mesh are told with the file, whoever finds out") {
  test_meshes::Mesh moebius;
  moebius.points = {{0, 0}, {1, 0}, {2, 1}, {1, 2}, {0, 2}};
  moebius.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
  const Files files(moebius);
  PipelineOptions options = files.options();
  const fakes::FakeBackend device;
  options.smoothing.backend = &device;
  for (const auto topology : {trismooth::Topology::halfedge, trismooth::Topology::device}) {
    options.smoothing.topology = topology;
    std::string message;
    try {
      trismooth::run_pipeline(options);
    } catch (const trismooth::ReadError& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find("in.off: ") != std::string::npos);
    CHECK(message.find("orient") != std::string::npos);
  }
}
