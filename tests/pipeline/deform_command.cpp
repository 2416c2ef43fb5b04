// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/cli/interrupt.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/quality/quality.h"

#include "catch.h"
#include "command_line_calls.h"
#include "support/rotor.h"
#include "support/scratch_folder.h"
#include "support/triangle_document.h"

namespace trismooth::deform_command_test {

using namespace command_line_calls;
using test_meshes::Point;
using test_meshes::Rotor;

constexpr double degrees = std::numbers::pi / 180;

/// The displacements of the rotor's corners where it turns and nothing else moves.
std::vector<double> displacements(const Rotor& rotor, double angle, double elsewhere = 0) {
  std::vector<double> numbers;
  for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
    const Point p = rotor.mesh.points[v];
    const Point q = rotor.is_on_rotor(v) ? test_meshes::turned(p, angle) : p;
    const double other = rotor.is_inside(v) ? elsewhere : 0;
    numbers.insert(numbers.end(), {q.x - p.x + other, q.y - p.y, 0});
  }
  return numbers;
}

std::string write_rotor(const ScratchFolder& folder, const std::string& name, const Rotor& rotor, double angle,
                        double elsewhere = 0) {
  MeshDocument document = triangle_document(rotor.mesh);
  document.point_arrays.push_back(make_data_array("motion", 3, displacements(rotor, angle, elsewhere)));
  write_mesh(folder / name, document);
  return (folder / name).string();
}

/// As a table of the rotor's vertices; `first`: the number of the first vertex of the mesh.
std::string write_table(const ScratchFolder& folder, const std::string& name, const Rotor& rotor, double angle,
                        int first = 0) {
  const std::vector<double> numbers = displacements(rotor, angle);
  std::string text = "vertex,dx,dy\n";
  for (int v = 0; v < rotor.sectors; ++v) {
    text += fmt::format("{},{},{}\n", v + first, numbers[3 * static_cast<std::size_t>(v)],
                        numbers[3 * static_cast<std::size_t>(v) + 1]);
  }
  return folder.write(name, text).string();
}

/// Triangles that are turned over against those of the rotor at rest, or have no area, by the file alone.
std::int64_t invalid_in(const MeshDocument& document, const Rotor& rotor) {
  std::int64_t invalid = 0;
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto area = [&](const auto& at) {
      const Point a = at(document.cells[c][0]), b = at(document.cells[c][1]), p = at(document.cells[c][2]);
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    const double now = area([&](std::int64_t v) {
      return Point{document.points[3 * static_cast<std::size_t>(v)],
                   document.points[3 * static_cast<std::size_t>(v) + 1]};
    });
    const double at_rest = area([&](std::int64_t v) { return rotor.mesh.points[static_cast<std::size_t>(v)]; });
    invalid += now * at_rest > 0 ? 0 : 1;
  }
  return invalid;
}

nlohmann::json report_of(const std::filesystem::path& path) {
  return nlohmann::json::parse(bytes_of(path));
}

TEST_CASE("the boundary of a file goes where its array says, the inside follows, and all else of the file stays") {
  const ScratchFolder folder;
  const Rotor rotor;
  const std::string input = write_rotor(folder, "rotor.vtu", rotor, 40 * degrees);
  const std::string output = (folder / "turned.vtu").string();
  const Outcome outcome = deform({input, output, "--displacement", "motion"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.shows("largest displacement"));
  const MeshDocument before = read_mesh(input);
  const MeshDocument after = read_mesh(output);
  CHECK(invalid_in(after, rotor) == 0);
  CHECK(after.cells.connectivity == before.cells.connectivity);
  REQUIRE(after.point_arrays.size() == 1);
  CHECK(std::ranges::equal(after.point_arrays[0].bytes, before.point_arrays[0].bytes));
  const std::vector<double> moved = displacements(rotor, 40 * degrees);
  std::size_t inside = 0;
  for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
    if (rotor.is_inside(v)) {
      inside += after.points[3 * v] != before.points[3 * v] ? 1 : 0;
      continue;
    }
    CHECK(after.points[3 * v] == before.points[3 * v] + moved[3 * v]);
    CHECK(after.points[3 * v + 1] == before.points[3 * v + 1] + moved[3 * v + 1]);
  }
  CHECK(inside > rotor.mesh.points.size() / 2);
}

TEST_CASE("displacements say the same as an array, as a table, by labels and on another mesh of the boundary") {
  const ScratchFolder folder;
  const Rotor rotor;
  const double angle = 25 * degrees;
  const std::string with_array = write_rotor(folder, "rotor.vtk", rotor, angle);
  const std::string plain = (folder / "plain.msh").string();
  write_mesh(plain, triangle_document(rotor.mesh));
  // The boundary as a body of its own, with points in another order.
  MeshDocument body;
  std::vector<double> motion;
  const std::vector<double> numbers = displacements(rotor, angle);
  for (int v = rotor.sectors - 1; v >= 0; --v) {
    const Point p = rotor.mesh.points[static_cast<std::size_t>(v)];
    body.points.insert(body.points.end(), {p.x, p.y, 0});
    motion.insert(motion.end(),
                  {numbers[3 * static_cast<std::size_t>(v)], numbers[3 * static_cast<std::size_t>(v) + 1]});
  }
  for (std::int32_t v = 0; v < rotor.sectors; ++v) {
    body.cells.append(cell_type::line, std::array{v, (v + 1) % rotor.sectors});
  }
  body.point_arrays.push_back(make_data_array("Motion", 2, motion));
  write_mesh(folder / "body.vtu", body);
  // Numbers alone, as Exodus II has them, in another order.
  MeshDocument split = triangle_document(rotor.mesh);
  for (const auto& [name, axis] : {std::pair("motion_z", 2), std::pair("Motion_Y", 1), std::pair("motionX", 0)}) {
    std::vector<double> along;
    for (std::size_t i = static_cast<std::size_t>(axis); i < numbers.size(); i += 3) {
      along.push_back(numbers[i]);
    }
    split.point_arrays.push_back(make_data_array(name, 1, std::move(along)));
  }
  const std::string with_numbers = (folder / "numbers.vtu").string();
  write_mesh(with_numbers, split);
  split.point_arrays.erase(split.point_arrays.begin());
  const std::string with_two = (folder / "two.vtu").string();
  write_mesh(with_two, split);
  const std::vector<Words> ways{
      {with_numbers, "--displacement", "motion"},
      {with_two, "--displacement", "motion_"},
      {with_array, "--displacement", "motion"},
      {plain, "--displacement-file", write_table(folder, "rows.csv", rotor, angle)},
      {plain, "--displacement-labels", "--displacement-file", write_table(folder, "labels.txt", rotor, angle, 1)},
      {plain, "--displacement", "motion", "--displacement-file", with_array},
      {plain, "--displacement", "Motion", "--displacement-file", (folder / "body.vtu").string()}};
  std::vector<double> first;
  for (const Words& way : ways) {
    Words words{way.front(), (folder / "out.off").string()};
    words.insert(words.end(), way.begin() + 1, way.end());
    const Outcome outcome = deform(words);
    CAPTURE(words, outcome.err);
    REQUIRE(outcome.code == 0);
    const std::vector<double> points = read_mesh(folder / "out.off").points;
    first = first.empty() ? points : first;
    CHECK(points == first);
  }
}

TEST_CASE("an array of one direction alone is no displacement, and what there is is listed") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  MeshDocument document = triangle_document(rotor.mesh);
  for (const char* const name : {"disp_x", "disp_z", "disp_q"}) {
    document.point_arrays.push_back(make_data_array(name, 1, std::vector<double>(document.point_count())));
  }
  write_mesh(folder / "x.vtu", document);
  const Outcome outcome =
      deform({(folder / "x.vtu").string(), (folder / "out.off").string(), "--displacement", "disp"});
  CHECK(outcome.code == 2);
  CHECK(outcome.says("no point array 'disp' to take displacements from; it has: disp_x, disp_z, disp_q"));
}

TEST_CASE("a series writes a mesh a step, the same for the same boundary, and tells of the worst one") {
  const ScratchFolder folder;
  const Rotor rotor;
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  Words words{input,      (folder / "out.vtu").string(),  "--report", (folder / "run.json").string(),
              "--report", (folder / "run.html").string(), "--steps"};
  for (int step = 1; step <= 11; ++step) {
    words.push_back(
        write_table(folder, fmt::format("{}.csv", step), rotor, 5 * degrees * (step <= 6 ? step : 12 - step)));
  }
  const Outcome outcome = deform(words);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.shows((folder / "out_01.vtu").string() + " to " + (folder / "out_11.vtu").string()));
  for (int step = 1; step <= 11; ++step) {
    CHECK(invalid_in(read_mesh(folder / fmt::format("out_{:02}.vtu", step)), rotor) == 0);
  }
  for (int step = 1; step <= 5; ++step) {
    CHECK(bytes_of(folder / fmt::format("out_{:02}.vtu", step)) ==
          bytes_of(folder / fmt::format("out_{:02}.vtu", 12 - step)));
  }
  // What a step is does not depend on those before it.
  REQUIRE(deform({input, (folder / "alone.vtu").string(), "--displacement-file", (folder / "6.csv").string()}).code ==
          0);
  CHECK(bytes_of(folder / "alone.vtu") == bytes_of(folder / "out_06.vtu"));

  const nlohmann::json report = report_of(folder / "run.json");
  const nlohmann::json& deformation = report["deformation"];
  REQUIRE(deformation["steps"].size() == 11);
  const std::size_t worst = deformation["worst_step"].get<std::size_t>() - 1;
  for (const nlohmann::json& step : deformation["steps"]) {
    CHECK(step["min_shape"] >= deformation["steps"][worst]["min_shape"]);
    CHECK(step["inverted"] == 0);
  }
  CHECK(report["after"]["metrics"]["shape"]["min"] == deformation["steps"][worst]["min_shape"]);
  CHECK(report["coordinates_hash"] == deformation["steps"][worst]["coordinates_hash"]);
  CHECK(deformation["steps"][2]["coordinates_hash"] == deformation["steps"][8]["coordinates_hash"]);
  double largest = 0;
  const std::vector<double> turned = read_mesh(folder / "out_06.vtu").points;
  for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
    largest = std::max(largest,
                       std::hypot(turned[3 * v] - rotor.mesh.points[v].x, turned[3 * v + 1] - rotor.mesh.points[v].y));
  }
  CHECK(deformation["steps"][5]["largest_displacement"].get<double>() == Catch::Detail::Approx(largest));
  CHECK(bytes_of(folder / "run.html").find("out_01.vtu to ") != std::string::npos);
}

TEST_CASE("every step of a series is to pass what is demanded") {
  const ScratchFolder folder;
  const Rotor rotor;
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  const std::string far = write_table(folder, "far.csv", rotor, 60 * degrees);
  const std::string near = write_table(folder, "near.csv", rotor, 0);
  const auto code_of = [&](const std::string& demand, const Words& steps) {
    Words words{input, (folder / "out.vtu").string(), "--require", demand, "--steps"};
    words.insert(words.end(), steps.begin(), steps.end());
    return deform(words).code;
  };
  const std::string demand = "mean_shape>=0.93";
  REQUIRE(code_of(demand, {near}) != code_of(demand, {far}));
  CHECK(code_of(demand, {near, far}) == 1);
  CHECK(code_of(demand, {far, near}) == 1);
  CHECK(code_of("inverted==0", {far, near}) == 0);
  // The one that is furthest from it tells, whichever comes first.
  const std::string farther = write_table(folder, "farther.csv", rotor, 100 * degrees);
  for (const Words& steps : {Words{near, far, farther}, Words{farther, far, near}}) {
    const std::string report = (folder / "run.json").string();
    Words words{input,       (folder / "out.vtu").string(),
                "--require", "min_shape>=0.999",
                "--require", "max_shape<=0.1",
                "--report",  report,
                "--steps"};
    words.insert(words.end(), steps.begin(), steps.end());
    CHECK(deform(words).code == 1);
    const nlohmann::json found = report_of(report);
    double least = 1;
    double most = 0;
    for (std::size_t step = 0; step < steps.size(); ++step) {
      const std::vector<double> stored = read_mesh(folder / fmt::format("out_{}.vtu", step + 1)).points;
      std::vector<Point> points;
      for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
        points.push_back({stored[3 * v], stored[3 * v + 1]});
      }
      const QualityReport found_here = quality(points, rotor.mesh.indices());
      least = std::min(least, found_here[Metric::shape].min);
      most = std::max(most, found_here[Metric::shape].max);
    }
    CHECK(found["gates"][0]["value"] == least);
    CHECK(found["gates"][1]["value"] == most);
  }
}

TEST_CASE("sweeps that end before the mesh has arrived are told") {
  const ScratchFolder folder;
  const Rotor rotor;
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  const std::string table = write_table(folder, "1.csv", rotor, 40 * degrees);
  const Words words{input, (folder / "out.vtu").string(), "--displacement-file", table};
  CHECK_FALSE(deform(words).says("still on its way"));
  Words few = words;
  few.insert(few.end(), {"--max-sweeps", "2"});
  CHECK(deform(few).says("the sweeps of 1 step ended at --max-sweeps, where the mesh was still on its way"));
}

TEST_CASE("steps of a compressed mesh are compressed, their numbers in front of both extensions") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  const std::string table = write_table(folder, "1.csv", rotor, 5 * degrees);
  REQUIRE(deform({input, (folder / "out.off.gz").string(), "--steps", table, table}).code == 0);
  for (const char* const name : {"out_1.off.gz", "out_2.off.gz"}) {
    CHECK(bytes_of(folder / name).starts_with("\x1f\x8b"));
    CHECK(read_mesh(folder / name).point_count() == rotor.mesh.points.size());
  }
}

TEST_CASE("a series ends where a signal came while the mesh of a step was put in its place") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  const std::string table = write_table(folder, "1.csv", rotor, 5 * degrees);
  const pid_t child = ::fork();
  if (child == 0) {
    end_on_interrupt();
    OutputFile(folder / "earlier.vtu").commit();
    std::raise(SIGINT);
    deform({input, (folder / "out.vtu").string(), "--steps", table, table});
    ::_exit(42);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(!std::filesystem::exists(folder / "out_1.vtu"));
}

TEST_CASE("names of the columns of a table are taken in, behind comments too") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  const std::string plain = folder.write("plain.csv", "3,0.01,0.02\n").string();
  REQUIRE(deform({input, (folder / "plain.vtu").string(), "--displacement-file", plain}).code == 0);
  for (const char* const names : {"vertex,dx,dy\n", "# by hand\n\n# of one vertex\nNode; U_X; U_Y\n",
                                  "\"id\",\"x\",\"y\",\"z\"\r\n", "a b c\n"}) {
    const std::string table = folder.write("named.csv", std::string(names) + "3,0.01,0.02\n").string();
    REQUIRE(deform({input, (folder / "named.vtu").string(), "--displacement-file", table}).code == 0);
    CHECK(bytes_of(folder / "named.vtu") == bytes_of(folder / "plain.vtu"));
  }
}

TEST_CASE("with --start previous a series goes on from step to step") {
  const ScratchFolder folder;
  const Rotor rotor;
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  Words words{input, (folder / "out.vtu").string(), "--start", "previous", "--steps"};
  for (int step = 1; step <= 4; ++step) {
    words.push_back(write_table(folder, fmt::format("{}.csv", step), rotor, 10 * degrees * step));
  }
  REQUIRE(deform(words).code == 0);
  const MeshDocument last = read_mesh(folder / "out_4.vtu");
  CHECK(invalid_in(last, rotor) == 0);
  CHECK(last.points[0] == rotor.mesh.points[0].x + displacements(rotor, 40 * degrees)[0]);
}

TEST_CASE("what does not go as the mesh should is said") {
  const ScratchFolder folder;
  const Rotor rotor;
  const std::string input = (folder / "rotor.vtu").string();
  write_mesh(input, triangle_document(rotor.mesh));
  const std::string output = (folder / "out.vtu").string();
  SECTION("a boundary that crosses itself, with the first step that does") {
    const std::string out_of_the_hole = folder.write("out.csv", "0 9 0\n").string();
    const std::string at_rest = folder.write("rest.csv", "0 0 0\n").string();
    const Outcome outcome = deform({input, output, "--steps", at_rest, out_of_the_hole});
    CHECK(outcome.code == 0);
    CHECK(outcome.says("the boundary crosses or touches itself in 1 of 2 steps, it is step 2"));
    CHECK(invalid_in(read_mesh(folder / "out_2.vtu"), rotor) > 0);
    CHECK(outcome.says("triangles are inverted or degenerate in 1 of 2 steps"));
    for (const char* const demand : {"inverted==0", "crossings==0"}) {
      CHECK(deform({input, output, "--require", demand, "--steps", at_rest, out_of_the_hole}).code == 1);
      CHECK(deform({input, output, "--require", demand, "--steps", at_rest}).code == 0);
    }
  }
  SECTION("a hole that is turned inside out") {
    std::string mirrored;
    for (int v = 0; v < rotor.sectors; ++v) {
      mirrored += fmt::format("{} {} 0\n", v, -2 * rotor.mesh.points[static_cast<std::size_t>(v)].x);
    }
    const std::string table = folder.write("mirrored.csv", mirrored).string();
    CHECK(deform({input, output, "--displacement-file", table}).says("lies over itself"));
    CHECK(deform({input, output, "--displacement-file", table, "--require", "overlaps==0"}).code == 1);
  }
  SECTION("vertices without a displacement, once") {
    const std::string table = write_table(folder, "a.csv", rotor, 0.1);
    const std::string other = write_table(folder, "b.csv", rotor, 0.2);
    const Outcome outcome = deform({input, output, "--steps", table, other});
    const std::string note = fmt::format("{} vertices that are held are without a displacement", rotor.sectors);
    CHECK(outcome.says("a.csv: " + note));
    CHECK(outcome.err.find(note) == outcome.err.rfind(note));
  }
  SECTION("displacements of vertices inside, which are not obeyed") {
    const std::string told = write_rotor(folder, "told.vtu", rotor, 0.1, 7);
    const Outcome outcome = deform({told, output, "--displacement", "motion"});
    CHECK(outcome.code == 0);
    CHECK(outcome.says("displacements of vertices inside are not obeyed"));
    CHECK(invalid_in(read_mesh(output), rotor) == 0);
  }
}

TEST_CASE("what a mesh cannot follow is refused, and nothing is written") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  const std::string input = write_rotor(folder, "rotor.vtu", rotor, 0.1);
  MeshDocument bad = triangle_document(rotor.mesh);
  bad.point_arrays.push_back(make_data_array("number", 1, std::vector<double>(bad.point_count(), 0)));
  bad.point_arrays.push_back(make_data_array("nowhere", 2, std::vector<double>(2 * bad.point_count(), NAN)));
  write_mesh(folder / "bad.vtk", bad);
  const std::string other = (folder / "bad.vtk").string();
  MeshDocument far = triangle_document(rotor.mesh);
  std::ranges::for_each(far.points, [](double& x) { x += 50; });
  far.point_arrays.push_back(make_data_array("motion", 2, std::vector<double>(2 * far.point_count(), 1)));
  far.cells = {};
  far.cells.append(cell_type::line, std::array{0, 1});
  write_mesh(folder / "far.vtu", far);
  const std::string table = write_table(folder, "rows.csv", rotor, 0.1);
  struct Refused {
    Words words;
    std::string says;
    int code;
  };
  const auto text = [&](const std::string& name, const std::string& bytes) {
    return folder.write(name, bytes).string();
  };
  const std::vector<Refused> all{
      {{}, "nothing says where the boundary goes", 2},
      {{"--displacement", "none"}, "it has: motion", 2},
      {{"--displacement-file", other}, "--displacement NAME", 2},
      {{"--displacement", "number", "--displacement-file", other}, "displacements have two or three", 2},
      {{"--displacement", "nowhere", "--displacement-file", other}, "no finite displacement for vertex 0", 2},
      {{"--displacement", "motion", "--displacement-file", (folder / "far.vtu").string()}, "gives no vertex", 2},
      {{"--displacement-file", (folder / "nix.csv").string()}, "no such file", 3},
      {{"--displacement-file", text("a.csv", "a,b,c\n1,2\n")}, ":2: expected a vertex and its displacement", 3},
      {{"--displacement-file", text("b.csv", "1;0,5;0,5\n")}, "have points", 3},
      {{"--displacement-file", text("k.csv", "3;0,1;0\n")}, "have points", 3},
      {{"--displacement-file", text("i.csv", "vertex,dy,dx\n1,0,0\n")}, "'dy' where dx is expected", 3},
      {{"--displacement-file", text("j.csv", "dx,dy,vertex\n1,0,0\n")}, "'dx' where a vertex is expected", 3},
      {{"--displacement-file", text("c.csv", "1 0 0\n1 0 0\n")}, "gives vertex 1 twice", 3},
      {{"--displacement-file", text("d.csv", "999 0 0\n")}, "names vertex 999", 3},
      {{"--displacement-file", text("e.csv", "-1 0 0\n")}, "names vertex -1", 3},
      {{"--displacement-file", text("f.csv", "1 0 nan\n")}, "f.csv:1", 3},
      {{"--displacement-file", text("g.csv", "1 0 0 0.1\n")}, "out of the plane of the mesh", 3},
      {{"--displacement-file", text("h.csv", "")}, "gives no vertex", 2},
      {{"--displacement-labels", "--displacement-file", table},
       "'--displacement-labels': a file of VTK XML (unstructured grid) gives its points no numbers of its own; the "
       "text "
       "without it takes their rows",
       2},
      {{"--displacement-file", table, "--steps", table}, "excludes", 2},
      {{"--time-limit", "1"}, "time-limit", 2},
      {{"--geographic"}, "geographic", 2}};
  const std::size_t files = folder.size();
  for (const Refused& refused : all) {
    Words words{input, (folder / "out.vtu").string()};
    words.insert(words.end(), refused.words.begin(), refused.words.end());
    const Outcome outcome = deform(words);
    CAPTURE(refused.words, outcome.err);
    CHECK(outcome.code == refused.code);
    CHECK(outcome.says(refused.says));
    CHECK(folder.size() == files);
  }
  CHECK(deform({input, "-", "--steps", table}).code == 2);
  std::filesystem::copy(input, folder / "step_1.vtu");
  CHECK(deform({(folder / "step_1.vtu").string(), (folder / "step.vtu").string(), "--steps", table})
            .says("would take the place of"));
  CHECK(
      deform({input, input, "--displacement", "motion", "--displacement-file", input}).says("would take the place of"));
}

TEST_CASE("points of two places in one are told apart by rows, not by where they are") {
  const ScratchFolder folder;
  // A slit: two triangles that touch along an edge, each with vertices of its own.
  MeshDocument slit;
  slit.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  slit.cells.append(cell_type::triangle, std::array{0, 1, 2});
  slit.cells.append(cell_type::triangle, std::array{3, 5, 4});
  write_mesh(folder / "slit.vtu", slit);
  MeshDocument opened = slit;
  opened.point_arrays.push_back(
      make_data_array("d", 2, std::vector<double>{0, 0, 0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5}));
  write_mesh(folder / "opened.vtu", opened);
  const std::string output = (folder / "out.vtu").string();
  REQUIRE(deform({(folder / "slit.vtu").string(), output, "--displacement", "d", "--displacement-file",
                  (folder / "opened.vtu").string()})
              .code == 0);
  CHECK(read_mesh(output).points ==
        std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1.5, 0.5, 0, 0.5, 1.5, 0, 1.5, 1.5, 0});
  // One more point, and rows say nothing any more.
  opened.points.insert(opened.points.end(), {9, 9, 0});
  opened.point_arrays = {
      make_data_array("d", 2, std::vector<double>{0, 0, 0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0, 0})};
  write_mesh(folder / "more.vtu", opened);
  const Outcome outcome = deform({(folder / "slit.vtu").string(), output, "--displacement", "d", "--displacement-file",
                                  (folder / "more.vtu").string()});
  CHECK(outcome.code == 2);
  CHECK(outcome.says("several points where vertex"));
}

TEST_CASE("a mesh of single precision, one in a tilted plane and one of few digits follow as well") {
  const ScratchFolder folder;
  const Rotor rotor(32, 7);
  const double angle = 30 * degrees;
  MeshDocument document = triangle_document(rotor.mesh);
  std::vector<double> motion = displacements(rotor, angle);
  SECTION("float32") {
    for (double& x : document.points) {
      x = static_cast<double>(static_cast<float>(x));
    }
    document.point_type = ScalarType::float32;
    document.point_arrays.push_back(make_data_array("motion", 3, motion));
    write_mesh(folder / "in.vtu", document);
    REQUIRE(deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement", "motion"}).code ==
            0);
    const MeshDocument after = read_mesh(folder / "out.vtu");
    CHECK(after.point_type == ScalarType::float32);
    CHECK(invalid_in(after, rotor) == 0);
    CHECK(after.points[0] == static_cast<double>(static_cast<float>(document.points[0] + motion[0])));
  }
  SECTION("tilted") {
    const auto tilt = [](std::vector<double>& vectors) {
      for (std::size_t i = 0; i < vectors.size(); i += 3) {
        const double y = vectors[i + 1];
        vectors[i + 1] = 0.8 * y;
        vectors[i + 2] = 0.6 * y;
      }
    };
    const std::vector<double> flat = [&] {
      document.point_arrays = {make_data_array("motion", 3, motion)};
      write_mesh(folder / "flat.vtu", document);
      REQUIRE(deform({(folder / "flat.vtu").string(), (folder / "f.vtu").string(), "--displacement", "motion"}).code ==
              0);
      return read_mesh(folder / "f.vtu").points;
    }();
    tilt(document.points);
    tilt(motion);
    document.point_arrays = {make_data_array("motion", 3, motion)};
    write_mesh(folder / "in.vtu", document);
    REQUIRE(deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement", "motion"}).code ==
            0);
    const std::vector<double> after = read_mesh(folder / "out.vtu").points;
    for (std::size_t i = 0; i < after.size(); i += 3) {
      CHECK(std::abs(after[i] - flat[i]) < 1e-4);
      CHECK(std::abs(after[i + 1] - 0.8 * flat[i + 1]) < 1e-4);
      CHECK(std::abs(after[i + 2] - 0.6 * flat[i + 1]) < 1e-4);
      CHECK(std::abs(0.6 * after[i + 1] - 0.8 * after[i + 2]) < 1e-12);
    }
  }
  SECTION("eight characters a number") {
    write_mesh(folder / "in.bdf", document);
    const std::string table = write_table(folder, "rows.csv", rotor, angle);
    const Outcome outcome =
        deform({(folder / "in.bdf").string(), (folder / "out.bdf").string(), "--displacement-file", table});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const MeshDocument after = read_mesh(folder / "out.bdf");
    CHECK(invalid_in(after, rotor) == 0);
    CHECK(std::abs(after.points[0] - (document.points[0] + motion[0])) < 1e-5);
  }
}

TEST_CASE("annotations show how far the vertices went from where the file has them") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  const std::string input = write_rotor(folder, "in.vtu", rotor, 0.2);
  const std::string output = (folder / "out.vtu").string();
  REQUIRE(deform({input, output, "--displacement", "motion", "--annotate"}).code == 0);
  const MeshDocument after = read_mesh(output);
  const DataArray* const displacement = find_array(after.point_arrays, "trismooth:displacement");
  REQUIRE(displacement != nullptr);
  for (std::size_t v = 0; v < after.point_count(); ++v) {
    CHECK(displacement->value(v, 0) == Catch::Detail::Approx(after.points[3 * v] - rotor.mesh.points[v].x));
  }
}

TEST_CASE("a library that embeds the stages is told what a mesh that follows its boundary cannot have") {
  const ScratchFolder folder;
  const Rotor rotor(16, 3);
  PipelineOptions options;
  options.input = write_rotor(folder, "in.vtu", rotor, 0.2);
  options.smoothing = moving_options();
  options.deformation.emplace().array = "motion";
  CHECK_THROWS_AS(run_pipeline(options), std::invalid_argument);  // no output
  options.output = folder / "out.vtu";
  MeshDocument document = read_mesh(options.input);
  CHECK_THROWS_AS(smooth_document(document, options), std::invalid_argument);
  options.smoothing.time_limit_seconds = 5;
  CHECK_THROWS_AS(run_pipeline(options), std::invalid_argument);
  options.smoothing.time_limit_seconds = std::numeric_limits<double>::infinity();
  options.slide.along = Slide::straight;
  CHECK_THROWS_AS(run_pipeline(options), std::invalid_argument);
  options.slide = {};
  const PipelineResult result = run_pipeline(options);
  REQUIRE(result.deformation);
  CHECK(result.deformation->steps.front().output == *options.output);
  CHECK(result.after->inverted == 0);
}

}  // namespace trismooth::deform_command_test
