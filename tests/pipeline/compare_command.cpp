// SPDX-License-Identifier: BSD-3-Clause
// trismooth compare: two meshes of the same elements.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "command_line_calls.h"
#include "support/parsed_page.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::compare_command_test {

using namespace command_line_calls;
using nlohmann::json;
using test_meshes::Mesh;
using test_meshes::Point;

/// Two files, and what comparing them says.
class Files {
 public:
  std::string write(const std::string& name, const MeshDocument& document) const {
    write_mesh(folder_ / name, document);
    return (folder_ / name).string();
  }
  std::string write(const std::string& name, const Mesh& mesh) const { return write(name, triangle_document(mesh)); }

  Outcome compare(const std::string& first, const std::string& second, Words more = {}) const {
    more.insert(more.begin(), {"compare", (folder_ / first).string(), (folder_ / second).string(), "--report",
                               (folder_ / "report.json").string()});
    return call(more, &run_pipeline);
  }
  Outcome smooth(const std::string& input, const std::string& output, Words more = {}) const {
    more.insert(more.begin(), {"smooth", (folder_ / input).string(), (folder_ / output).string(), "--report",
                               (folder_ / "smooth.json").string()});
    return call(more, &run_pipeline);
  }
  json report(const std::string& name = "report.json") const { return json::parse(bytes_of(folder_ / name)); }
  const ScratchFolder& folder() const { return folder_; }

 private:
  ScratchFolder folder_;
};

/// The squares of a board, cut in two.
Mesh board() {
  return test_meshes::jittered_grid(5, 5, 0, 3);
}

double shape_of(const Mesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const Point p = mesh.points[a], q = mesh.points[b], r = mesh.points[c];
  const auto squared = [](Point s, Point t) { return (t.x - s.x) * (t.x - s.x) + (t.y - s.y) * (t.y - s.y); };
  const double doubled_area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return 2 * std::sqrt(3.0) * doubled_area / (squared(p, q) + squared(q, r) + squared(r, p));
}

/// The root mean square distance to the neighbours.
double length_around(const Mesh& mesh, std::int32_t vertex) {
  std::set<std::int32_t> neighbours;
  for (const Triangle& triangle : mesh.triangles) {
    if (std::ranges::count(triangle, vertex) > 0) {
      neighbours.insert(triangle.begin(), triangle.end());
    }
  }
  neighbours.erase(vertex);
  double sum = 0;
  for (const std::int32_t other : neighbours) {
    sum += std::pow(
        std::hypot(mesh.points[other].x - mesh.points[vertex].x, mesh.points[other].y - mesh.points[vertex].y), 2);
  }
  return std::sqrt(sum / static_cast<double>(neighbours.size()));
}

TEST_CASE("vertices moved by hand are counted, with how far they went") {
  const Files files;
  Mesh mesh = board();
  files.write("a.off", mesh);
  const Mesh before = mesh;
  mesh.points[12].x += 0.06;
  mesh.points[12].y -= 0.08;
  mesh.points[6].y += 0.109375;
  files.write("b.off", mesh);
  const Outcome outcome = files.compare("a.off", "b.off");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.shows("2 of 25 vertices, by 0.109 at most (vertex 6)"));
  CHECK(outcome.shows("none of them is held by a smoothing"));
  const json report = files.report();
  const json& found = report["comparison"];
  CHECK(found["moved_vertices"] == 2);
  CHECK(found["rounded_vertices"] == 0);
  CHECK(found["held_vertices"] == 0);
  CHECK(found["farthest_vertex"] == 6);
  CHECK(found["largest_displacement"].get<double>() == Approx(0.109375));
  CHECK(found["mean_displacement"].get<double>() == Approx((0.109375 + 0.1) / 2));
  const double of_12 = 0.1 / length_around(before, 12);
  const double of_6 = 0.109375 / length_around(before, 6);
  CHECK(found["largest_relative_displacement"].get<double>() == Approx(of_6));
  CHECK(found["mean_relative_displacement"].get<double>() == Approx((of_6 + of_12) / 2));
  std::int64_t better = 0;
  std::int64_t worse = 0;
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double change = shape_of(mesh, t) - shape_of(before, t);
    better += change > 1e-12 ? 1 : 0;
    worse += change < -1e-12 ? 1 : 0;
    least = std::min(least, shape_of(mesh, t));
  }
  CHECK(found["better_elements"] == better);
  CHECK(found["worse_elements"] == worse);
  CHECK(report["before"]["metrics"]["shape"]["min"].get<double>() == Approx(shape_of(before, 0)));
  CHECK(report["after"]["metrics"]["shape"]["min"].get<double>() == Approx(least));
  CHECK(report["smoothing"].is_null());
  CHECK(report["coordinates_hash"].is_null());
}

TEST_CASE("a boundary that moved is told, with the areas of the domain") {
  const Files files;
  Mesh mesh = board();
  files.write("a.off", mesh);
  mesh.points[24] = {1.5, 1};  // the corner: a triangle more, as high as a side and half as wide
  mesh.points[12].x += 0.01;
  files.write("b.off", mesh);
  const Outcome outcome = files.compare("a.off", "b.off");
  CHECK(outcome.code == 0);
  CHECK(
      outcome.says("1 vertex moved that a smoothing without --slide holds (1 boundary): the domain or its regions "
                   "may have changed; areas changed by 6.2 % at most"));
  const json report = files.report();
  CHECK(report["comparison"]["moved_vertices"] == 2);
  CHECK(report["comparison"]["held_vertices"] == 1);
  CHECK(report["comparison"]["held"]["boundary"] == 1);
  REQUIRE(report["areas"].size() == 1);
  CHECK(report["areas"][0]["before"].get<double>() == Approx(1));
  CHECK(report["areas"][0]["after"].get<double>() == Approx(1 + 0.5 * 0.5 * 0.25));
  CHECK(report["warnings"].size() == 1);
}

TEST_CASE("an interface that moved is told, with the areas of both regions") {
  const Files files;
  Mesh mesh = board();
  MeshDocument document = triangle_document(mesh);
  std::vector<double> region(mesh.triangles.size());
  for (std::size_t t = 0; t < region.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    region[t] = mesh.points[a].x + mesh.points[b].x + mesh.points[c].x < 1.5 ? 1 : 2;
  }
  document.cell_arrays.push_back(make_data_array("region", 1, region));
  files.write("a.vtu", document);
  mesh.points[12].x += 0.1;
  files.write("b.off", mesh);
  CHECK(files.compare("a.vtu", "b.off").says("1 vertex moved that a smoothing without --slide holds (1 interface)"));
  json report = files.report();
  REQUIRE(report["areas"].size() == 2);
  for (const auto& [region_number, sign] : {std::pair(0, 1.0), {1, -1.0}}) {
    CHECK(report["areas"][region_number]["before"].get<double>() == Approx(0.5));
    CHECK(report["areas"][region_number]["after"].get<double>() == Approx(0.5 + sign * 0.1 * 0.25));
  }
  CHECK(report["after"]["regions"].size() == 2);
  // Without regions nothing holds it.
  CHECK(files.compare("a.vtu", "b.off", {"--region-array", "none"}).err.empty());
  const std::string ids = files.folder().write("ids.txt", "12\n").string();
  CHECK(files.compare("a.vtu", "b.off", {"--region-array", "none", "--fixed-ids", ids})
            .says("1 vertex moved that a smoothing holds (1 named)\n"));
}

/// Whether the report of the comparison has what that of the smoothing has.
void check_same_numbers(const Files& files) {
  const json smoothed = files.report("smooth.json");
  const json compared = files.report();
  for (const char* const key : {"before", "after", "size_change", "input"}) {
    CAPTURE(key);
    CHECK(smoothed[key] == compared[key]);
  }
  CHECK(smoothed["smoothing"]["moved_vertices"] == compared["comparison"]["moved_vertices"]);
  CHECK(smoothed["smoothing"]["moved_vertices"] > 10);
  CHECK(compared["comparison"]["held_vertices"] == 0);
}

TEST_CASE("a mesh and its own smoothed result have the numbers of the smoothing's report, in whatever formats") {
  const Files files;
  const Mesh mesh = test_meshes::jittered_grid(14, 11, 0.45, 5);
  MeshDocument document = triangle_document(mesh);
  std::vector<double> region(mesh.triangles.size());
  for (std::size_t t = 0; t < region.size(); ++t) {
    region[t] = t < region.size() / 2 ? 1 : 2;
  }
  document.cell_arrays.push_back(make_data_array("region", 1, region));
  files.write("a.vtu", document);
  for (const std::string name : {"b.vtu", "b.off", "b.msh", "b.mesh", "b.ply", "b.inp", "b.stl"}) {
    CAPTURE(name);
    REQUIRE(files.smooth("a.vtu", name).code == 0);
    const Outcome outcome = files.compare("a.vtu", name);
    REQUIRE(outcome.code == 0);
    if (name == "b.inp") {
      continue;  // has fewer digits
    }
    check_same_numbers(files);
    if (name != "b.stl") {
      CHECK(files.report("smooth.json")["coordinates_hash"] == files.report()["comparison"]["coordinates_hash"]);
    }
    CHECK(outcome.says("in other rows") == (name == "b.stl"));
  }
}

TEST_CASE("quadrilaterals and elements of six nodes have the numbers of the smoothing's report") {
  const Files files;
  const Mesh mesh = test_meshes::jittered_grid(10, 9, 0.3, 4);
  MeshDocument document = triangle_document(mesh);
  SECTION("six nodes") {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    document.cells = {};
    for (const Triangle& triangle : mesh.triangles) {
      std::vector<std::int32_t> nodes(triangle.begin(), triangle.end());
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair<std::int32_t, std::int32_t> side = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        const auto next = static_cast<std::int32_t>(document.point_count());
        const auto [found, is_new] = middles.try_emplace(side, next);
        if (is_new) {
          const Point p = mesh.points[side.first], q = mesh.points[side.second];
          document.points.insert(document.points.end(), {(p.x + q.x) / 2, (p.y + q.y) / 2, 0});
        }
        nodes.push_back(found->second);
      }
      document.cells.append(cell_type::quadratic_triangle, nodes);
    }
  }
  SECTION("quadrilaterals") {
    document.cells = {};
    for (std::int32_t v = 0; v + 11 < 90; ++v) {
      if (v % 10 != 9) {
        document.cells.append(cell_type::quad, std::array{v, v + 1, v + 11, v + 10});
      }
    }
  }
  files.write("a.vtu", document);
  REQUIRE(files.smooth("a.vtu", "b.vtu").code == 0);
  REQUIRE(files.compare("a.vtu", "b.vtu").code == 0);
  const json smoothed = files.report("smooth.json");
  const json compared = files.report();
  CHECK(smoothed["before"] == compared["before"]);
  CHECK(smoothed["after"] == compared["after"]);
  CHECK(compared["comparison"]["held_vertices"] == 0);
  CHECK(compared["comparison"]["moved_vertices"] > 10);
}

TEST_CASE("elements may be listed in another order and from another corner on") {
  const Files files;
  Mesh mesh = board();
  files.write("a.off", mesh);
  mesh.points[12].x += 0.1;
  files.write("b.off", mesh);
  REQUIRE(files.compare("a.off", "b.off").code == 0);
  const json expected = files.report();
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) {
    std::rotate(mesh.triangles[t].begin(), mesh.triangles[t].begin() + 1, mesh.triangles[t].end());
    std::ranges::reverse(mesh.triangles[t + 1]);
  }
  files.write("rotated.off", mesh);
  std::ranges::reverse(mesh.triangles);
  files.write("reversed.off", mesh);
  for (const std::string name : {"rotated.off", "reversed.off"}) {
    CAPTURE(name);
    const Outcome outcome = files.compare("a.off", name);
    CHECK(outcome.code == 0);
    CHECK(outcome.says("lists the elements in another order") == (name == "reversed.off"));
    const json found = files.report();
    CHECK(found["after"] == expected["after"]);
    CHECK(found["comparison"]["mean_displacement"] == expected["comparison"]["mean_displacement"]);
  }
}

TEST_CASE("points in other rows are told by the elements, and those of no element may be missing") {
  const Files files;
  Mesh mesh = board();
  mesh.points.push_back({7, 7});
  files.write("a.off", mesh);
  mesh.points.pop_back();
  mesh.points[12].x += 0.0625;
  std::ranges::reverse(mesh.points);
  for (Triangle& triangle : mesh.triangles) {
    for (std::int32_t& v : triangle) {
      v = 24 - v;
    }
  }
  files.write("b.off", mesh);
  const Outcome outcome = files.compare("a.off", "b.off");
  CHECK(outcome.code == 0);
  CHECK(outcome.says("has 25 points in other rows than"));
  const json found = files.report()["comparison"];
  CHECK(found["moved_vertices"] == 1);
  CHECK(found["farthest_vertex"] == 12);
  CHECK(found["largest_displacement"].get<double>() == 0.0625);
}

TEST_CASE("other meshes are refused, and it is said what differs first") {
  const Files files;
  const Mesh mesh = board();
  files.write("a.off", mesh);
  const auto refusal = [&](const std::string& name, const Mesh& other) {
    files.write(name, other);
    const Outcome outcome = files.compare("a.off", name);
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK_FALSE(std::filesystem::exists(files.folder() / "report.json"));
    return outcome.err;
  };
  const auto has = [](const std::string& text, const std::string& words) { return text.find(words) != text.npos; };
  Mesh other = mesh;
  other.triangles.pop_back();
  std::string said = refusal("elements.off", other);
  CHECK(has(said, "elements.off: holds 25 points and 31 triangles, and "));
  CHECK(has(said,
            "a.off holds 25 points and 32 triangles; two meshes are compared that have the same points and the "
            "same elements; save both from one mesh"));
  // A diagonal of a square is flipped.
  other = mesh;
  const Triangle first = mesh.triangles[6];
  const Triangle second = mesh.triangles[7];
  const auto alone_in = [](const Triangle& triangle, const Triangle& beside) {
    return *std::ranges::find_if(triangle, [&](std::int32_t v) { return std::ranges::count(beside, v) == 0; });
  };
  const std::int32_t d = alone_in(second, first);
  const std::int32_t lone = alone_in(first, second);
  std::vector<std::int32_t> ends;
  std::ranges::copy_if(first, std::back_inserter(ends), [&](std::int32_t v) { return v != lone; });
  other.triangles[6] = {ends[0], d, lone};
  other.triangles[7] = {ends[1], d, lone};
  said = refusal("flipped.off", other);
  CHECK(has(said, "flipped.off: element 6 has the points " + std::to_string(ends[0]) + ", " + std::to_string(d) + ", " +
                      std::to_string(lone) + " (cell 6), and in "));
  CHECK(has(said, "the points " + std::to_string(first[0]) + ", " + std::to_string(first[1]) + ", " +
                      std::to_string(first[2]) + " (cell 6), all counted from 0"));
  // A point more, of which an element makes use.
  other = mesh;
  other.points.push_back({2, 2});
  other.triangles[9][1] = 25;
  CHECK(has(refusal("points.off", other), "points.off: holds 26 points and 32 triangles, and "));
}

TEST_CASE("quadrilaterals that a format splits are other elements, and it is said why") {
  const Files files;
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
  document.cells.append(cell_type::quad, std::array{0, 1, 4, 3});
  document.cells.append(cell_type::quad, std::array{1, 2, 5, 4});
  files.write("a.vtu", document);
  files.write("b.stl", document);
  const Outcome outcome = files.compare("a.vtu", "b.stl");
  CHECK(outcome.code == 3);
  CHECK(outcome.says("holds 6 points and 4 triangles"));
  CHECK(outcome.says("holds 6 points and 2 quadrilaterals"));
  CHECK(outcome.says("formats without quadrilaterals (STL, FreeFem, Triangle) have two triangles for each"));
}

TEST_CASE("a mesh that lies in no plane, that is not there or that is in pieces is refused by its name") {
  const Files files;
  const Mesh mesh = board();
  files.write("a.off", mesh);
  MeshDocument bent = triangle_document(mesh);
  bent.points[3 * 12 + 2] = 0.25;
  files.write("b.off", bent);
  Outcome outcome = files.compare("a.off", "b.off");
  CHECK(outcome.code == 3);
  CHECK(outcome.says("b.off: the mesh is not planar"));
  CHECK(files.compare("a.off", "b.off", {"--project", "xy"}).code == 0);
  CHECK(files.report()["comparison"]["largest_displacement"] == 0);
  outcome = files.compare("a.off", "none.off");
  CHECK(outcome.code == 3);
  CHECK(outcome.says("none.off: cannot be opened"));
  outcome = files.compare("a.off", "b.pvtu");
  CHECK(outcome.code == 3);
  CHECK(outcome.says("b.pvtu: is a mesh in pieces"));
}

TEST_CASE("corners that --merge joins in one mesh and the other has apart are refused") {
  const Files files;
  // Two squares of two triangles each, which meet in two vertices apiece.
  Mesh mesh{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}},
            {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}};
  files.write("a.vtk", mesh);
  files.write("same.vtk", mesh);
  mesh.points[7] = {1.25, 1};
  files.write("torn.vtk", mesh);
  CHECK(files.compare("a.vtk", "same.vtk", {"--merge", "1e-9"}).code == 0);
  const Outcome outcome = files.compare("a.vtk", "torn.vtk", {"--merge", "1e-9"});
  CHECK(outcome.code == 3);
  CHECK(outcome.err.find("1 corner that --merge joins in the other mesh is further apart here than that; compare "
                         "without --merge") != std::string::npos);
  CHECK(files.compare("a.vtk", "torn.vtk").code == 0);
}

TEST_CASE("gates are judged on the second mesh") {
  const Files files;
  Mesh mesh = board();
  files.write("a.off", mesh);
  mesh.points[12].x += 0.6;  // over its neighbours
  files.write("b.off", mesh);
  const Outcome outcome = files.compare("a.off", "b.off", {"--require", "inverted==0"});
  CHECK(outcome.code == 1);
  CHECK(outcome.says("gate failed: inverted == 0"));
  const json report = files.report();
  std::int64_t inverted = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    inverted += shape_of(mesh, t) < 0 ? 1 : 0;
  }
  REQUIRE(inverted > 0);
  CHECK(report["gates"][0]["value"] == inverted);
  CHECK(report["comparison"]["newly_invalid_elements"] == inverted);
  CHECK(outcome.says(std::to_string(inverted) + " triangles are inverted or degenerate in "));
  CHECK(files.compare("a.off", "b.off").code == 0);
  // The other way round they are mended.
  const Outcome back = files.compare("b.off", "a.off", {"--require", "inverted==0"});
  CHECK(back.code == 0);
  CHECK(back.err.empty());
  CHECK(files.report()["comparison"]["newly_valid_elements"] == inverted);
}

TEST_CASE("coordinates that a file rounds have not moved, and a note counts them") {
  const Files files;
  const Mesh mesh = test_meshes::jittered_grid(6, 6, 0.3, 8);
  files.write("a.off", mesh);
  MeshDocument document = triangle_document(mesh);
  document.points[3 * 14] += 0.01;
  document.point_type = ScalarType::float32;
  std::int64_t rounded = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    bool differs = false;
    for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
      const double exact = document.points[i];
      document.points[i] = static_cast<float>(exact);
      differs = differs || document.points[i] != exact;
    }
    rounded += differs && v != 14 ? 1 : 0;
  }
  files.write("b.vtu", document);
  const Outcome outcome = files.compare("a.off", "b.vtu");
  CHECK(outcome.code == 0);
  REQUIRE(rounded > 10);
  CHECK(outcome.says(std::to_string(rounded) + " vertices differ by the rounding of the numbers of a file alone"));
  CHECK(files.report()["comparison"]["moved_vertices"] == 1);
  CHECK(files.report()["comparison"]["rounded_vertices"] == rounded);
  CHECK(files.report()["warnings"].empty());
  CHECK(files.compare("b.vtu", "a.off").code == 0);
  CHECK(files.report()["comparison"]["rounded_vertices"] == rounded);
}

TEST_CASE("the same mesh twice says that nothing moved") {
  const Files files;
  files.write("a.off", board());
  const Outcome outcome = files.compare("a.off", "a.off");
  CHECK(outcome.code == 0);
  CHECK(outcome.shows("no vertex: the coordinates are the same"));
  CHECK(outcome.out.find("better") == std::string::npos);
  CHECK(files.report()["comparison"]["farthest_vertex"].is_null());
}

TEST_CASE("a mirrored mesh is as good as the other one, and said to be mirrored") {
  const Files files;
  Mesh mesh = test_meshes::jittered_grid(6, 5, 0.3, 8);
  files.write("a.off", mesh);
  for (Point& p : mesh.points) {
    p.x = -p.x;
  }
  files.write("b.off", mesh);
  const Outcome outcome = files.compare("a.off", "b.off");
  CHECK(outcome.code == 0);
  CHECK(outcome.says("b.off is mirrored against "));
  const json report = files.report();
  CHECK(report["comparison"]["mirrored_elements"] == mesh.triangles.size());
  CHECK(report["after"]["inverted"] == 0);
  CHECK(report["after"]["metrics"]["shape"]["min"].get<double>() ==
        Approx(report["before"]["metrics"]["shape"]["min"].get<double>()));
}

TEST_CASE("a mesh in another plane is measured there, and displacements in space") {
  const Files files;
  const Mesh mesh = test_meshes::jittered_grid(6, 5, 0.3, 8);
  files.write("a.off", mesh);
  MeshDocument turned = triangle_document(mesh);
  double largest = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point p = mesh.points[v];
    const std::array now{0.6 * p.x, p.y, 0.8 * p.x};
    std::ranges::copy(now, turned.points.begin() + 3 * static_cast<std::ptrdiff_t>(v));
    largest = std::max(largest, std::hypot(now[0] - p.x, now[1] - p.y, now[2]));
  }
  files.write("b.off", turned);
  const Outcome outcome = files.compare("a.off", "b.off");
  CHECK(outcome.code == 0);
  CHECK(outcome.says("b.off: lies in another plane; each mesh is measured in its own"));
  const json report = files.report();
  CHECK(report["comparison"]["largest_displacement"].get<double>() == Approx(largest));
  CHECK(report["comparison"]["mirrored_elements"] == 0);
  CHECK(report["after"]["metrics"]["shape"]["mean"].get<double>() ==
        Approx(report["before"]["metrics"]["shape"]["mean"].get<double>()));
  CHECK(report["areas"][0]["after"].get<double>() == Approx(1));
}

TEST_CASE("longitudes that jump across the date line are where they are") {
  const Files files;
  Mesh mesh = board();
  for (Point& p : mesh.points) {
    p = {179.2 + p.x, 40 + p.y};
  }
  files.write("a.off", mesh);
  const double before = mesh.points[12].x;
  mesh.points[12].x += 0.125;
  for (Point& p : mesh.points) {
    p.x -= 360;
  }
  files.write("b.off", mesh);
  const Outcome outcome = files.compare("a.off", "b.off", {"--geographic"});
  CHECK(outcome.code == 0);
  const json found = files.report()["comparison"];
  CHECK(found["farthest_vertex"] == 12);
  CHECK(found["largest_displacement"].get<double>() == Approx(0.125).margin(1e-9));
  CHECK(files.report()["size_change"]["ratio_p99"].get<double>() < 2);
  mesh.points[12].y = 95;
  files.write("b.off", mesh);
  const Outcome refused = files.compare("a.off", "b.off", {"--geographic"});
  CHECK(refused.code == 3);
  CHECK(refused.says("b.off: vertex 12 is at "));
  CHECK(before < 180);
}

TEST_CASE("a report is not written over a mesh that is compared, and standard input is one of the two") {
  const Files files;
  files.write("a.off", board());
  const std::string twin = (files.folder() / "b.json").string();
  write_mesh(files.folder() / "b.off", triangle_document(board()));
  std::filesystem::rename(files.folder() / "b.off", twin);
  Words words{"compare", (files.folder() / "a.off").string(), twin, "--format", "off", "--report", twin};
  const Outcome outcome = call(words, &run_pipeline);
  CHECK(outcome.code == 2);
  CHECK(outcome.says("is the same file as"));
  const Outcome streams = call({"compare", "-", "-"}, &run_pipeline);
  CHECK(streams.code == 2);
  CHECK(streams.says("two meshes are compared, of which standard input can be one"));
  CHECK(call({"compare", "a.off"}, &run_pipeline).code == 2);
  CHECK(call({"compare", "a.off", "b.off", "--method", "smart"}, &run_pipeline).code == 2);
}

TEST_CASE("the page is that of a comparison") {
  const Files files;
  Mesh mesh = board();
  files.write("a.off", mesh);
  mesh.points[24].x += 0.01;
  files.write("b <c>.off", mesh);
  const std::string page_name = (files.folder() / "page.html").string();
  REQUIRE(files.compare("a.off", "b <c>.off", {"--report", page_name}).code == 0);
  const pages::Parsed page = pages::parse(bytes_of(page_name));
  REQUIRE(page.error.empty());
  for (const char* const words : {"Mesh comparison report", "b <c>.off", "What moved", "1 of 25 vertices moved",
                                  "1 boundary", "before", "after", "Warnings"}) {
    CAPTURE(words);
    CHECK(page.says(words));
  }
  CHECK_FALSE(page.says("Convergence"));
  CHECK_FALSE(page.says("Smoothing"));
}

TEST_CASE("pictures show the second mesh, and how far it is from the first") {
  const Files files;
  Mesh mesh = board();
  files.write("a.off", mesh);
  mesh.points[12].x += 0.125;
  files.write("b.off", mesh);
  const auto picture_of = [&](const std::string& name, Words words) {
    const std::string picture = (files.folder() / name).string();
    words.insert(words.end(), {"--picture", picture});
    const Outcome outcome = call(words, &run_pipeline);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return bytes_of(picture);
  };
  const std::string first = (files.folder() / "a.off").string();
  const std::string second = (files.folder() / "b.off").string();
  CHECK(picture_of("compared.svg", {"compare", first, second}) == picture_of("second.svg", {"quality", second}));
  CHECK(picture_of("moved.svg", {"compare", first, second, "--picture-metric", "moved"}).find("0.125") !=
        std::string::npos);
}

TEST_CASE("the library compares two files, and nothing else beside") {
  const Files files;
  Mesh mesh = board();
  PipelineOptions options;
  options.input = files.write("a.off", mesh);
  mesh.points[12].x += 0.25;
  options.compared = files.write("b.off", mesh);
  const PipelineResult result = run_pipeline(options);
  REQUIRE(result.comparison);
  CHECK(result.comparison->moved_vertices == 1);
  CHECK(result.comparison->largest_displacement == 0.25);
  CHECK(result.after);
  CHECK_FALSE(result.smoothing);
  MeshDocument document = triangle_document(mesh);
  CHECK_THROWS_AS(check_document(document, options), std::invalid_argument);
  options.output = files.folder() / "c.off";
  CHECK_THROWS_AS(run_pipeline(options), std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(files.folder() / "c.off"));
}

}  // namespace trismooth::compare_command_test
