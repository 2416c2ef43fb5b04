// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/moving_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/small_selafin.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::moving_fields_test {

double plane(double x, double y) {
  return 3 * x - 7 * y + 2;
}

/// A mesh with a linear field, a vector of two, whole numbers, and a field that no plane is.
MeshDocument sample() {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(25, 25, 0.4, 5);
  MeshDocument document = triangle_document(mesh);
  std::vector<double> heat;
  std::vector<float> wind;
  std::vector<std::int32_t> id;
  std::vector<double> wave;
  for (const auto& [x, y] : mesh.points) {
    heat.push_back(plane(x, y));
    wind.insert(wind.end(), {static_cast<float>(x), static_cast<float>(-y)});
    id.push_back(static_cast<std::int32_t>(id.size()));
    wave.push_back(std::sin(20 * x) * std::cos(20 * y));
  }
  document.point_arrays = {make_data_array("heat", 1, heat), make_data_array("wind", 2, wind),
                           make_data_array("id", 1, id), make_data_array("wave", 1, wave)};
  return document;
}

struct Run {
  ScratchFolder folder;
  PipelineOptions options;

  explicit Run(const std::string& input, const std::string& output) {
    options.input = folder / input;
    options.output = folder / output;
    write_mesh(options.input, sample());
  }
  PipelineResult run() const { return run_pipeline(options); }
  MeshDocument output() const { return read_mesh(*options.output); }
  MeshDocument input() const { return read_mesh(options.input); }
};

bool same_values(const DataArray& a, const DataArray& b) {
  return std::ranges::equal(a.bytes, b.bytes);
}

void check_linear(const MeshDocument& document) {
  const DataArray& heat = *find_array(document.point_arrays, "heat");
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    CHECK(std::abs(heat.value(v) - plane(document.points[3 * v], document.points[3 * v + 1])) < 1e-13);
  }
}

TEST_CASE("a linear field is the same function of the place after the smoothing, in every format that has fields") {
  for (const char* const name : {"m.vtk", "m.vtu", "m.vtp", "m.ply"}) {
    if (!is_available(*trismooth::format_of(name))) {
      continue;
    }
    INFO(name);
    Run run(name, std::string("out-") + name);
    run.options.fields = Fields::interpolate;
    const PipelineResult result = run.run();
    CHECK(result.smoothing->moved_vertices > 300);
    const std::int64_t moved = result.smoothing->moved_vertices;
    if (std::string(name) == "m.ply") {
      CHECK(result.fields.size() == 4);  // PLY has a property for each component
    } else {
      CHECK(result.fields == std::vector<InterpolatedField>{{"heat", moved}, {"wind", moved}, {"wave", moved}});
    }
    CHECK(result.losses.empty());
    const MeshDocument before = run.input();
    const MeshDocument after = run.output();
    check_linear(after);
    const DataArray& old_wave = *find_array(before.point_arrays, "wave");
    const DataArray& wave = *find_array(after.point_arrays, "wave");
    std::int64_t others = 0;
    for (std::size_t v = 0; v < after.point_count(); ++v) {
      const bool stayed = std::equal(&after.points[3 * v], &after.points[3 * v] + 3, &before.points[3 * v]);
      CHECK((!stayed || wave.value(v) == old_wave.value(v)));
      others += wave.value(v) != old_wave.value(v) ? 1 : 0;
    }
    CHECK(others > moved / 2);
    CHECK(same_values(*find_array(before.point_arrays, "id"), *find_array(after.point_arrays, "id")));
  }
}

TEST_CASE("by default fields stay with their vertices, and names choose some") {
  Run run("m.vtk", "out.vtk");
  const PipelineResult result = run.run();
  CHECK(result.fields.empty());
  CHECK(result.kept_fields == std::vector<std::string>{"heat", "wind", "wave"});
  const MeshDocument before = run.input();
  for (std::size_t i = 0; i < before.point_arrays.size(); ++i) {
    CHECK(same_values(before.point_arrays[i], run.output().point_arrays[i]));
  }
  run.options.field_arrays = {"h*"};
  CHECK(run.run().fields.size() == 1);
  check_linear(run.output());
  CHECK(same_values(before.point_arrays[3], run.output().point_arrays[3]));
  // Who has said something knows it, and what is not written is told as lost.
  CHECK(run.run().kept_fields.empty());
  run.options.field_arrays.clear();
  run.options.fields = Fields::keep;
  CHECK(run.run().kept_fields.empty());
  run.options.fields.reset();
  run.options.output = run.folder / "out.off";
  CHECK(run.run().kept_fields.empty());
}

TEST_CASE("what another format gets as its depths follows the mesh as its own depths do") {
  struct Way {
    const char* file;
    const char* array;
    double sign;
  };
  for (const Way& way : {Way{"m.14", "depth", 1}, Way{"m.2dm", "elevation", -1}, Way{"m.slf", "BOTTOM", -1}}) {
    for (const bool keeps : {false, true}) {
      INFO(way.file << ' ' << keeps);
      Run run("m.vtu", way.file);
      MeshDocument document = sample();
      document.point_arrays = {document.point_arrays[3], document.point_arrays[0]};
      document.point_arrays[1].name = "Depth";
      write_mesh(run.options.input, document);
      run.options.fields = keeps ? std::optional(Fields::keep) : std::nullopt;
      const PipelineResult result = run.run();
      REQUIRE(result.smoothing->moved_vertices > 300);
      CHECK(result.fields == (keeps ? std::vector<InterpolatedField>{}
                                    : std::vector<InterpolatedField>{{"Depth", result.smoothing->moved_vertices}}));
      const MeshDocument after = run.output();
      const DataArray& written = *find_array(after.point_arrays, way.array);
      for (std::size_t v = 0; v < after.point_count(); ++v) {
        const double expected =
            keeps ? document.point_arrays[1].value(v) : plane(after.points[3 * v], after.points[3 * v + 1]);
        REQUIRE(std::abs(written.value(v) - way.sign * expected) < 1e-13);
      }
    }
  }
}

TEST_CASE("depths in whole numbers stay, and a note says so") {
  Run run("m.vtu", "m.14");
  MeshDocument document = sample();
  document.point_arrays = {document.point_arrays[2]};
  document.point_arrays[0].name = "depth";
  write_mesh(run.options.input, document);
  const PipelineResult result = run.run();
  CHECK(result.fields.empty());
  CHECK(std::ranges::count(result.notes, "the point array 'depth' holds whole numbers: it is not interpolated") == 1);
}

TEST_CASE("a bottom of several time steps stays in its file, which is said with the way out, and follows elsewhere") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(25, 25, 0.4, 5);
  test_support::SmallSelafin file;
  file.head({"BOTTOM"});
  file.integers(
      {static_cast<std::int32_t>(mesh.triangles.size()), static_cast<std::int32_t>(mesh.points.size()), 3, 1});
  std::vector<std::int32_t> nodes;
  for (const auto& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle) {
      nodes.push_back(vertex + 1);
    }
  }
  file.integers(nodes);
  file.integers(std::vector<std::int32_t>(mesh.points.size()));
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> bottom;
  for (const auto& point : mesh.points) {
    x.push_back(point.x);
    y.push_back(point.y);
    bottom.push_back(plane(point.x, point.y));
  }
  file.reals(x);
  file.reals(y);
  for (const double time : {0.0, 60.0}) {
    file.reals({time});
    file.reals(bottom);
  }
  for (const char* const name : {"out.slf", "out.14"}) {
    INFO(name);
    Run run("m.vtu", name);
    run.options.input = run.folder.write("steps.slf", file.bytes());
    const PipelineResult result = run.run();
    REQUIRE(result.smoothing->moved_vertices > 300);
    if (std::string_view(name) == "out.slf") {
      CHECK(result.fields.empty());
      CHECK(result.losses.back() ==
            "the point array 'BOTTOM' is not interpolated: SELAFIN files of several time steps are written back with "
            "the values that were read; written to another format, such as .vtu or .med, it is");
    } else {
      CHECK(result.fields == std::vector<InterpolatedField>{{"BOTTOM", result.smoothing->moved_vertices}});
    }
  }
}

TEST_CASE("vertices beside a value that stands for none are counted, and the note names a way out, which works") {
  Run run("m.vtk", "out.vtk");
  MeshDocument document = sample();
  std::vector<double> heat;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    heat.push_back(v % 50 == 13 ? -99999 : document.point_arrays[0].value(v));
  }
  document.point_arrays[0] = make_data_array("heat", 1, heat);
  write_mesh(run.options.input, document);
  run.options.field_arrays = {"heat"};
  const PipelineResult result = run.run();
  const MeshDocument after = run.output();
  std::int64_t kept = 0;
  for (std::size_t v = 0; v < heat.size(); ++v) {
    const bool moved = !std::equal(&after.points[3 * v], &after.points[3 * v] + 3, &document.points[3 * v]);
    kept += moved && after.point_arrays[0].value(v) == heat[v] ? 1 : 0;
    CHECK((after.point_arrays[0].value(v) == -99999) == (heat[v] == -99999));
  }
  CHECK(kept > 10);
  CHECK(result.fields == std::vector<InterpolatedField>{{"heat", result.smoothing->moved_vertices - kept}});
  CHECK(
      std::ranges::count(result.notes, std::to_string(kept) +
                                           " vertices that moved stay as read in 'heat': at corners of their places "
                                           "there is no value (-99999), with which none is interpolated; fill them in "
                                           "first, or keep all values as read with --fields keep") == 1);
  run.options.field_arrays.clear();
  run.options.fields = Fields::keep;
  for (const std::string& note : run.run().notes) {
    CHECK(note.find("no value") == std::string::npos);
  }
  CHECK(same_values(run.output().point_arrays[0], document.point_arrays[0]));
}

TEST_CASE("a depth that is no number stays where it is, and no other depth becomes one") {
  for (const std::string extension : {".14", ".2dm"}) {
    INFO(extension);
    Run run("m" + extension, "out" + extension);
    MeshDocument document = sample();
    std::vector<double> depth;
    for (std::size_t v = 0; v < document.point_count(); ++v) {
      depth.push_back(v % 50 == 13 ? std::nan("") : plane(document.points[3 * v], document.points[3 * v + 1]));
    }
    document.point_arrays = {make_data_array("depth", 1, depth)};
    write_mesh(run.options.input, document);
    const PipelineResult result = run.run();
    CHECK(result.smoothing->moved_vertices > 300);
    const MeshDocument before = run.input();
    const MeshDocument after = run.output();
    const DataArray& values = after.point_arrays.at(0);
    for (std::size_t v = 0; v < depth.size(); ++v) {
      CHECK(std::isnan(values.value(v)) == std::isnan(depth[v]));
      CHECK((std::isnan(depth[v]) || values.value(v) == before.point_arrays[0].value(v) ||
             std::abs(std::abs(values.value(v)) - std::abs(plane(after.points[3 * v], after.points[3 * v + 1]))) <
                 1e-12));
    }
    CHECK(std::ranges::any_of(result.notes, [](const std::string& note) {
      return note.find("there is no value (nan)") != std::string::npos;
    }));
  }
}

TEST_CASE("the result does not depend on the number of threads, nor on whether the file is converted") {
  Run run("m.vtk", "out.vtk");
  run.options.fields = Fields::interpolate;
  run.options.annotate = true;
  run.run();
  const std::string one = bytes_of(*run.options.output);
  run.options.smoothing.threads = 4;
  run.run();
  CHECK(bytes_of(*run.options.output) == one);
  const MeshDocument kept = run.output();
  run.options.output = run.folder / "out.ply";
  run.run();
  CHECK(same_values(*find_array(run.output().point_arrays, "heat"), *find_array(kept.point_arrays, "heat")));
}

TEST_CASE("annotations are the same with fields that move") {
  Run run("m.vtk", "out.vtk");
  run.options.annotate = true;
  run.run();
  const MeshDocument kept = run.output();
  run.options.fields = Fields::interpolate;
  run.run();
  const MeshDocument moved = run.output();
  CHECK(kept.points == moved.points);
  for (const char* const name : {"trismooth:fixed", "trismooth:displacement"}) {
    CHECK(same_values(*find_array(kept.point_arrays, name), *find_array(moved.point_arrays, name)));
  }
}

}  // namespace trismooth::moving_fields_test
