// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/pipeline.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iomanip>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/report/held_text.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::pipeline_test {

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

TEST_CASE("whoever finds the topology, file and report are the same") {
  using trismooth::Topology;
  const auto topology = GENERATE(Topology::automatic, Topology::host, Topology::halfedge, Topology::device);
  CAPTURE(trismooth::to_string(topology));
  const Files files(irregular_mesh());
  PipelineOptions options = files.options();
  options.smoothing.topology = topology;
  const PipelineResult expected = trismooth::run_pipeline(options);
  const std::string expected_output = files.output();
  REQUIRE(expected.input.components >= 2);
  REQUIRE(expected.input.reoriented_triangles > 0);
  REQUIRE(expected.notes.size() == 2);

  // A backend that finds rings is asked to where it may.
  const fakes::FakeBackend device;
  options.smoothing.backend = &device;
  const PipelineResult found = trismooth::run_pipeline(options);
  CHECK(device.rings_found == (topology == Topology::automatic || topology == Topology::device ? 1 : 0));
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

TEST_CASE("by default a device without memory for the topology leaves it to the host; asked for it, it fails") {
  const Files files(irregular_mesh());
  PipelineOptions options = files.options();
  trismooth::run_pipeline(options);
  const std::string expected = files.output();
  const fakes::FakeBackend device(fakes::Failure::rings);
  options.smoothing.backend = &device;
  const PipelineResult found = trismooth::run_pipeline(options);
  CHECK(device.rings_found == 1);
  CHECK(device.smoothed == 1);
  CHECK(files.output() == expected);
  REQUIRE(found.smoothing);
  CHECK(found.smoothing->backend_note.starts_with("the host found the neighbours: CUDA: cudaErrorMemoryAllocation"));
  options.smoothing.topology = trismooth::Topology::device;
  CHECK_THROWS_AS(trismooth::run_pipeline(options), trismooth::DeviceError);
}

TEST_CASE("the paper's versions find the topology on the device only where that is asked for") {
  const Files files(irregular_mesh());
  PipelineOptions options = files.options();
  options.smoothing.execution = trismooth::Execution::single_block;
  const fakes::FakeBackend device;
  options.smoothing.backend = &device;
  trismooth::run_pipeline(options);
  CHECK(device.rings_found == 0);
}

TEST_CASE("the backend starts while the file is read, and what it has not started then it starts later") {
  const Files files(test_meshes::jittered_grid(200, 200, 0.45, 5));
  PipelineOptions options = files.options();
  const PipelineResult expected = trismooth::run_pipeline(options);

  fakes::FakeBackend device;
  std::promise<void> has_read;
  bool was_read_meanwhile = false;
  device.when_started = [&] {
    was_read_meanwhile = has_read.get_future().wait_for(std::chrono::seconds(60)) == std::future_status::ready;
    throw trismooth::DeviceError("it fails to start");  // and need not tell it
  };
  options.smoothing.backend = &device;
  options.stage_started = [&](trismooth::Stage stage) {
    if (stage == trismooth::Stage::topology) {
      has_read.set_value();
    }
    return trismooth::Progress::proceed;
  };
  const PipelineResult found = trismooth::run_pipeline(options);
  CHECK(was_read_meanwhile);
  CHECK(found.coordinates_hash == expected.coordinates_hash);
  CHECK(found.smoothing->backend == "cuda");
  // About as many as there are: whether a device pays is decided by that.
  CHECK(device.started_for > 20'000);
  CHECK(device.started_for < 80'000);

  const fakes::FakeBackend not_needed;
  options.smoothing.backend = &not_needed;
  options.output.reset();
  options.stage_started = {};
  trismooth::run_pipeline(options);
  CHECK(not_needed.started_for == -1);
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
    const trismooth::DataArray* const array = find_array(document.cell_arrays, "trismooth:shape");
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

TEST_CASE("coordinates of two types: vertices that stay keep their digits, the others are numbers of both types") {
  const test_meshes::Mesh grid = test_meshes::jittered_grid(9, 9, 0.4, 3);
  // In the plane of the axes, and in a tilted one.
  for (const double tilt : {0.0, 0.75}) {
    CAPTURE(tilt);
    std::string rows;
    for (const auto& [x, y] : grid.points) {
      rows += fmt::format("{} {} {}\n", x / 3, static_cast<float>(y), tilt * (x / 3));
    }
    for (const auto& [a, b, c] : grid.triangles) {
      rows += fmt::format("3 {} {} {}\n", a, b, c);
    }
    const ScratchFolder folder;
    PipelineOptions options;
    options.input = folder.write(
        "in.ply",
        fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty float y\n"
                    "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
                    grid.points.size(), grid.triangles.size()) +
            rows);
    options.output = folder / "out.ply";
    const PipelineResult result = trismooth::run_pipeline(options);
    const trismooth::MeshDocument before = trismooth::read_mesh(options.input);
    const trismooth::MeshDocument after = trismooth::read_mesh(*options.output);
    std::int64_t moved = 0;
    for (std::size_t v = 0; v < before.point_count(); ++v) {
      const auto old = std::span(before.points).subspan(3 * v, 3);
      const auto now = std::span(after.points).subspan(3 * v, 3);
      if (!std::ranges::equal(old, now)) {
        ++moved;
        CHECK((now[0] == static_cast<double>(static_cast<float>(now[0])) && now[0] != old[0]));
      }
    }
    CHECK(moved == result.smoothing->moved_vertices);
    CHECK(moved > 0);
    CHECK(moved < static_cast<std::int64_t>(before.point_count()));
    CHECK(result.after->inverted <= result.before.inverted);
    // To another format with every digit.
    options.output = folder / "out.vtu";
    trismooth::run_pipeline(options);
    CHECK(trismooth::read_mesh(*options.output).points == after.points);
  }
}

TEST_CASE("annotations become properties of a PLY that is made, or that has some; else one that was read takes none") {
  const ScratchFolder folder;
  PipelineOptions options;
  options.annotate = true;
  options.input = folder.write("in.off",
                               "OFF\n5 4 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0.5 1.25 0\n3 0 1 4\n3 1 2 4\n"
                               "3 2 3 4\n3 3 0 4\n");
  options.output = folder / "out.ply";
  const auto about_annotate = [](const PipelineResult& result) {
    return std::ranges::count_if(result.notes, [](const std::string& note) { return note.starts_with("--annotate"); });
  };
  CHECK(about_annotate(trismooth::run_pipeline(options)) == 0);
  const trismooth::MeshDocument annotated = trismooth::read_mesh(*options.output);
  const auto has = [](const std::vector<trismooth::DataArray>& arrays, const std::string& end) {
    return std::ranges::any_of(arrays, [&](const auto& array) { return array.name.ends_with(end); });
  };
  CHECK(has(annotated.cell_arrays, "shape"));
  CHECK(has(annotated.point_arrays, "fixed"));
  CHECK(has(annotated.point_arrays, "displacement_2"));

  options.input = *options.output;
  options.output = folder / "again.ply";
  CHECK(about_annotate(trismooth::run_pipeline(options)) == 0);
  const trismooth::MeshDocument renewed = trismooth::read_mesh(*options.output);
  CHECK(renewed.cell_arrays.size() == annotated.cell_arrays.size());
  CHECK(renewed.point_arrays.size() == annotated.point_arrays.size());

  options.annotate = false;
  options.output = folder / "plain.ply";
  trismooth::run_pipeline(options);
  options.annotate = true;
  options.input = *options.output;
  options.output = folder / "plain_again.ply";
  const PipelineResult again = trismooth::run_pipeline(options);
  REQUIRE(about_annotate(again) == 1);
  const auto note = std::ranges::find_if(again.notes, [](const auto& n) { return n.starts_with("--annotate"); });
  CHECK(note->find("PLY files that were read are written back with nothing added") != std::string::npos);
}

TEST_CASE("triangles that are no mesh are told with the file, whoever finds out") {
  test_meshes::Mesh moebius;
  moebius.points = {{0, 0}, {1, 0}, {2, 1}, {1, 2}, {0, 2}};
  moebius.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
  const Files files(moebius);
  PipelineOptions options = files.options();
  const fakes::FakeBackend device;
  options.smoothing.backend = &device;
  for (const auto topology : {trismooth::Topology::host, trismooth::Topology::halfedge, trismooth::Topology::device}) {
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

TEST_CASE("arrays of float are smoothed to the bits of a file of float32") {
  const test_meshes::Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(14, 11, 0.45, 5), 3);
  std::vector<std::array<float, 3>> points;
  for (const auto& p : mesh.points) {
    points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0.25F});
  }
  const ScratchFolder folder;
  {
    std::ofstream file(folder / "in.ply");
    file << "ply\nformat ascii 1.0\nelement vertex " << points.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n"
         << std::setprecision(9);
    for (const auto& [x, y, z] : points) {
      file << x << ' ' << y << ' ' << z << '\n';
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      file << "3 " << a << ' ' << b << ' ' << c << '\n';
    }
  }
  PipelineOptions options;
  options.input = folder / "in.ply";
  options.output = folder / "out.ply";
  const PipelineResult result = run_pipeline(options);
  REQUIRE(result.smoothing->moved_vertices > 50);
  CHECK(trismooth::smooth(points, mesh.triangles).moved_vertices == result.smoothing->moved_vertices);
  std::vector<double> expected;
  for (const auto& point : points) {
    expected.insert(expected.end(), point.begin(), point.end());
  }
  CHECK(trismooth::read_mesh(*options.output).points == expected);
}

TEST_CASE("the files that belong to the output are among the results") {
  const ScratchFolder folder;
  trismooth::PipelineOptions options;
  options.input = folder / "in.off";
  trismooth::write_mesh(options.input, triangle_document(test_meshes::jittered_grid(5, 5, 0.3, 1)));
  const auto others = [&](const char* name) {
    options.output = folder / name;
    return trismooth::run_pipeline(options).other_outputs;
  };
  using Paths = std::vector<std::filesystem::path>;
  CHECK(others("out.off").empty());
  CHECK(others("out.off.gz").empty());
  CHECK(others("out.node") == Paths{folder / "out.ele"});
  CHECK(others("out.xdmf") == trismooth::codec_of(trismooth::FileFormat::xdmf).other_files_of(folder / "out.xdmf"));
}

TEST_CASE("a mesh that was turned over is reported as it is turned now") {
  // The inside is mirrored, so most triangles are inverted and taken for the others.
  test_meshes::Mesh mesh = test_meshes::jittered_grid(11, 11, 0.2, 3);
  for (auto& [x, y] : mesh.points) {
    x = x > 0 && x < 1 && y > 0 && y < 1 ? 1 - x : x;
  }
  const Files files(mesh);
  PipelineOptions options = files.options();
  options.smoothing.method = trismooth::Method::mean_ratio;
  const PipelineResult result = trismooth::run_pipeline(options);
  REQUIRE(result.smoothing);
  REQUIRE(result.smoothing->untangling);
  CHECK(result.smoothing->untangling->turned_components == 1);
  CHECK(result.before.inverted > 0);
  REQUIRE(result.after);
  CHECK(result.after->inverted == 0);
  CHECK(result.after->metrics[0].min > 0);

  PipelineOptions again;
  again.input = *options.output;
  CHECK(trismooth::run_pipeline(again).before.metrics[0].min == result.after->metrics[0].min);
}

TEST_CASE("a mesh in pieces is for the program over MPI ranks alone") {
  const auto refusal = [](const PipelineOptions& options) -> std::string {
    try {
      trismooth::run_pipeline(options);
      return {};
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  PipelineOptions pieces;
  pieces.input = "big.pvtu";
  CHECK(refusal(pieces).find("big.pvtu: is a mesh in pieces, which 'trismooth smooth' and 'quality' read") == 0);
  const Files files(test_meshes::jittered_grid(3, 3, 0.2, 1));
  PipelineOptions options = files.options();
  options.output = "out.pvtu";
  CHECK(refusal(options).find("out.pvtu: is the name of a mesh in pieces") == 0);
}

}  // namespace trismooth::pipeline_test
