// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/halfedge_stage.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::halfedge_stage_test {

using cell_type::triangle;

/// The mesh, of the unit square, as a document; triangles on the left are in region 7, the others in region 3.
MeshDocument document_of(const test_meshes::Mesh& mesh) {
  MeshDocument document = triangle_document(mesh);
  std::vector<std::int32_t> regions;
  for (const Triangle& t : mesh.triangles) {
    regions.push_back(mesh.points[t[0]].x + mesh.points[t[1]].x + mesh.points[t[2]].x < 1.2 ? 7 : 3);
  }
  document.cell_arrays.push_back(trismooth::make_data_array("region", 1, std::move(regions)));
  document.format = trismooth::FileFormat::vtk;
  return document;
}

test_meshes::Mesh grid() {
  return test_meshes::shuffled(test_meshes::jittered_grid(12, 9, 0.3, 4), 6);
}

/// How many edges each vertex is away from one of two regions, found in the list of triangles, pass by pass.
std::vector<std::int32_t> distances(const MeshDocument& document) {
  std::vector<std::set<std::int64_t>> regions(document.point_count());
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    for (const std::int32_t v : document.cells[cell]) {
      regions[static_cast<std::size_t>(v)].insert(static_cast<std::int64_t>(document.cell_arrays[0].value(cell)));
    }
  }
  std::vector<std::int32_t> found(document.point_count(), -1);
  for (std::size_t v = 0; v < found.size(); ++v) {
    found[v] = regions[v].size() > 1 ? 0 : -1;
  }
  for (std::int32_t distance = 1; distance < std::ssize(found); ++distance) {
    for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
      const auto corners = document.cells[cell];
      const bool is_near = std::ranges::any_of(
          corners, [&](std::int32_t v) { return found[static_cast<std::size_t>(v)] == distance - 1; });
      for (const std::int32_t v : corners) {
        auto& of_corner = found[static_cast<std::size_t>(v)];
        of_corner = is_near && of_corner < 0 ? distance : of_corner;
      }
    }
  }
  return found;
}

/// The same by circulating, as a user would.
std::vector<std::int32_t> distances_by_halfedges(const HalfedgeStage& stage) {
  std::vector<std::int32_t> found(stage.document.point_count(), -1);
  std::vector<OpenMesh::VertexHandle> front;
  const auto reach = [&](OpenMesh::VertexHandle v, std::int32_t distance) {
    auto& known = found[static_cast<std::size_t>(stage.point_of(v))];
    if (known < 0) {
      known = distance;
      front.push_back(v);
    }
  };
  for (const auto e : stage.mesh.edges()) {
    if (!e.is_boundary() && stage.regions[static_cast<std::size_t>(e.h0().face().idx())] !=
                                stage.regions[static_cast<std::size_t>(e.h1().face().idx())]) {
      reach(e.v0(), 0);
      reach(e.v1(), 0);
    }
  }
  for (std::int32_t distance = 1; !front.empty(); ++distance) {
    for (const auto v : std::exchange(front, {})) {
      for (const auto neighbour : stage.mesh.vv_range(v)) {
        reach(neighbour, distance);
      }
    }
  }
  return found;
}

bool stays(const MeshDocument& before, const MeshDocument& after, std::size_t v) {
  return std::equal(before.points.begin() + 3 * static_cast<std::ptrdiff_t>(v),
                    before.points.begin() + 3 * static_cast<std::ptrdiff_t>(v + 1),
                    after.points.begin() + 3 * static_cast<std::ptrdiff_t>(v));
}

PipelineOptions options_with(std::function<void(HalfedgeStage&)> stage) {
  PipelineOptions options;
  options.input = "in memory";
  options.halfedge_stage = std::move(stage);
  return options;
}

TEST_CASE("a stage of the program's own has the points, triangles, cells and regions of the file as halfedges") {
  MeshDocument document = document_of(grid());
  // A cell that is no triangle comes first: faces are not cells.
  const std::array<std::int32_t, 2> line{0, 1};
  MeshDocument with_line = document;
  with_line.cells = {};
  with_line.cells.append(trismooth::cell_type::line, line);
  std::vector<std::int32_t> regions{0};
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    with_line.cells.append(triangle, document.cells[cell]);
    regions.push_back(static_cast<std::int32_t>(document.cell_arrays[0].value(cell)));
  }
  with_line.cell_arrays[0] = trismooth::make_data_array("region", 1, std::move(regions));
  int calls = 0;
  trismooth::check_document(with_line, options_with([&](HalfedgeStage& stage) {
                              ++calls;
                              stage.point_arrays.push_back(trismooth::make_data_array(
                                  "a", 1, std::vector<double>(stage.document.point_count())));
                              REQUIRE(stage.mesh.n_vertices() == document.point_count());
                              REQUIRE(stage.mesh.n_faces() == document.cells.size());
                              REQUIRE(stage.regions.size() == document.cells.size());
                              for (const auto v : stage.mesh.vertices()) {
                                CHECK(stage.mesh.point(v) == Eigen::Vector3d(document.points.data() + 3 * v.idx()));
                              }
                              for (const auto f : stage.mesh.faces()) {
                                REQUIRE(stage.cells[static_cast<std::size_t>(f.idx())] == f.idx() + 1);
                                std::set<std::int32_t> corners;
                                for (const auto v : stage.mesh.fv_range(f)) {
                                  corners.insert(v.idx());
                                }
                                const auto expected = document.cells[static_cast<std::size_t>(f.idx())];
                                CHECK(corners == std::set<std::int32_t>(expected.begin(), expected.end()));
                                const bool is_first =
                                    document.cell_arrays[0].value(static_cast<std::size_t>(f.idx())) == 7;
                                CHECK((stage.regions[static_cast<std::size_t>(f.idx())] == stage.regions[0]) ==
                                      (is_first == (document.cell_arrays[0].value(0) == 7)));
                              }
                            }));
  CHECK(calls == 1);
  CHECK(with_line.point_arrays.empty());  // a check changes nothing
}

TEST_CASE("vertices near an interface, found by circulating, are held, and the output says how near they are") {
  MeshDocument document = document_of(grid());
  const MeshDocument before = document;
  const std::vector<std::int32_t> expected = distances(before);
  REQUIRE(std::ranges::max(expected) > 3);
  MeshDocument without = document;
  trismooth::smooth_document(without, options_with({}));

  const auto hold_near = [](HalfedgeStage& stage) {
    std::vector<std::int32_t> found = distances_by_halfedges(stage);
    for (const std::int32_t distance : found) {
      stage.fixed.push_back(distance <= 2 ? 1 : 0);
    }
    stage.point_arrays.push_back(trismooth::make_data_array("distance", 1, std::move(found)));
  };
  const PipelineResult result = trismooth::smooth_document(document, options_with(hold_near));
  CHECK(result.topology == trismooth::Topology::halfedge);
  CHECK(result.input.held.named > 0);
  std::int64_t held = 0;
  for (std::size_t v = 0; v < expected.size(); ++v) {
    if (expected[v] <= 2) {
      CHECK(stays(before, document, v));
      held += stays(before, without, v) ? 0 : 1;
    }
  }
  CHECK(held > 0);  // which would have moved
  CHECK(result.smoothing->moved_vertices > 0);
  const trismooth::DataArray* const distance = trismooth::find_array(document.point_arrays, "distance");
  REQUIRE(distance != nullptr);
  for (std::size_t v = 0; v < expected.size(); ++v) {
    CHECK(distance->value(v) == expected[v]);
  }

  SECTION("from file to file, with annotations and without") {
    const bool annotate = GENERATE(false, true);
    const ScratchFolder folder;
    trismooth::write_mesh(folder / "in.vtk", before);
    PipelineOptions options = options_with(hold_near);
    options.input = folder / "in.vtk";
    options.output = folder / "out.vtk";
    options.annotate = annotate;
    const PipelineResult run = trismooth::run_pipeline(options);
    CHECK(run.coordinates_hash == result.coordinates_hash);
    const MeshDocument written = trismooth::read_mesh(*options.output);
    const trismooth::DataArray* const again = trismooth::find_array(written.point_arrays, "distance");
    REQUIRE(again != nullptr);
    CHECK(std::ranges::equal(again->bytes, distance->bytes));
    CHECK((trismooth::find_array(written.point_arrays, "trismooth:fixed") != nullptr) == annotate);
    options.output = folder / "out.ply";
    options.halfedge_stage = [](HalfedgeStage& stage) {
      stage.point_arrays.push_back(trismooth::make_data_array(
          "far", 1, std::vector<std::int64_t>(stage.document.point_count(), std::int64_t{1} << 40)));
    };
    const PipelineResult ply = trismooth::run_pipeline(options);
    CHECK(std::ranges::any_of(ply.losses,
                              [](const std::string& loss) { return loss.find("'far'") != std::string::npos; }));
    options.output = folder / "out.off";
    const PipelineResult off = trismooth::run_pipeline(options);
    CHECK(std::ranges::any_of(off.notes, [](const std::string& note) {
      return note.find("does not take the point arrays of the program's own stage; write .vt") != std::string::npos;
    }));
  }
}

TEST_CASE("a stage that asks for nothing changes nothing, whatever the topology would have been") {
  MeshDocument plain = document_of(grid());
  MeshDocument seen = plain;
  const PipelineResult expected = trismooth::smooth_document(plain, options_with({}));
  PipelineOptions options = options_with([](HalfedgeStage&) {});
  options.smoothing.topology = GENERATE(trismooth::Topology::automatic, trismooth::Topology::halfedge);
  const PipelineResult result = trismooth::smooth_document(seen, options);
  CHECK(seen.points == plain.points);
  CHECK(result.notes == expected.notes);
  CHECK(seen.point_arrays.empty());
}

TEST_CASE("a point where fans meet is a vertex of the stage's mesh for each of them") {
  const test_meshes::Mesh mesh = test_meshes::bow_tie();
  MeshDocument document = document_of(mesh);
  const MeshDocument before = document;
  std::multiset<std::int32_t> points;
  trismooth::check_document(
      document, options_with([&](HalfedgeStage& stage) {
        for (const auto v : stage.mesh.vertices()) {
          points.insert(stage.point_of(v));
          CHECK(stage.mesh.point(v) == Eigen::Vector3d(before.points.data() + 3 * stage.point_of(v)));
        }
      }));
  CHECK(points.size() == mesh.points.size() + 1);
  CHECK(std::set(points.begin(), points.end()).size() == mesh.points.size());
}

TEST_CASE("middles of sides are vertices without a face, and a note tells who holds them what that holds") {
  const test_meshes::Mesh mesh = grid();
  MeshDocument document;
  for (const auto& p : mesh.points) {
    document.points.insert(document.points.end(), {p.x, p.y, 0.0});
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  for (const Triangle& t : mesh.triangles) {
    std::array<std::int32_t, 6> nodes{t[0], t[1], t[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto side = std::minmax(t[i], t[(i + 1) % 3]);
      const auto [place, is_new] = middles.emplace(side, static_cast<std::int32_t>(document.point_count()));
      nodes[3 + i] = place->second;
      if (is_new) {
        const auto& a = mesh.points[static_cast<std::size_t>(side.first)];
        const auto& b = mesh.points[static_cast<std::size_t>(side.second)];
        document.points.insert(document.points.end(), {(a.x + b.x) / 2, (a.y + b.y) / 2, 0.0});
      }
    }
    document.cells.append(trismooth::cell_type::quadratic_triangle, nodes);
  }
  document.format = trismooth::FileFormat::vtk;
  const MeshDocument before = document;
  const bool skips_middles = GENERATE(true, false);
  const PipelineResult result = trismooth::smooth_document(
      document, options_with([&](HalfedgeStage& stage) {
        stage.fixed.resize(stage.document.point_count());
        for (const auto v : stage.mesh.vertices()) {
          CHECK(stage.mesh.is_isolated(v) == (v.idx() >= static_cast<int>(mesh.points.size())));
          stage.fixed[static_cast<std::size_t>(stage.point_of(v))] =
              v.is_boundary() && !(skips_middles && stage.mesh.is_isolated(v)) ? 1 : 0;
        }
      }));
  const bool is_told = std::ranges::any_of(result.notes, [&](const std::string& note) {
    return note.starts_with("the program's own stage holds " + std::to_string(middles.size()) + " middles of sides");
  });
  CHECK(is_told == !skips_middles);
  CHECK((document.points != before.points) == skips_middles);
}

TEST_CASE("what a stage hands out is refused where it does not fit, and the mesh is as it was") {
  struct Case {
    std::function<void(HalfedgeStage&)> stage;
    std::string words;
  };
  const Case refused = GENERATE(
      Case{[](HalfedgeStage& stage) { stage.fixed.resize(3); }, "halfedge_stage: fixed has 3 rows for 108 points"},
      Case{[](HalfedgeStage& stage) {
             stage.point_arrays.push_back(trismooth::make_data_array("a", 1, std::vector<double>(5)));
           },
           "the array 'a' has 5 rows for 108 points"},
      Case{[](HalfedgeStage& stage) {
             stage.point_arrays.push_back(trismooth::make_data_array("depth", 1, std::vector<double>(108)));
           },
           "there is a point array 'depth' already"},
      Case{[](HalfedgeStage& stage) {
             for (int i = 0; i < 2; ++i) {
               stage.point_arrays.push_back(trismooth::make_data_array("a", 1, std::vector<double>(108)));
             }
           },
           "there is a point array 'a' already"},
      Case{[](HalfedgeStage& stage) {
             stage.point_arrays.push_back(trismooth::make_data_array("trismooth:a", 1, std::vector<double>(108)));
           },
           "a name that does not begin with 'trismooth:'"},
      Case{[](HalfedgeStage&) { throw std::runtime_error("of the caller's"); }, "of the caller's"});
  MeshDocument document = document_of(grid());
  document.point_arrays.push_back(trismooth::make_data_array("depth", 1, std::vector<double>(108)));
  const std::vector<double> points = document.points;
  CHECK_THROWS_WITH(trismooth::smooth_document(document, options_with(refused.stage)), Catch::Contains(refused.words));
  CHECK(document.points == points);
  CHECK(document.point_arrays.size() == 1);
}

TEST_CASE("a stage of halfedges goes with no other topology") {
  MeshDocument document = document_of(grid());
  PipelineOptions options = options_with([](HalfedgeStage&) {});
  options.smoothing.topology = GENERATE(trismooth::Topology::host, trismooth::Topology::device);
  CHECK_THROWS_WITH(trismooth::smooth_document(document, options), Catch::Contains("topology 'auto' or 'halfedge'"));
}

}  // namespace trismooth::halfedge_stage_test
