// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/gates.h"
#include "trismooth/pipeline/halfedge_stage.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/format_sample.h"
#include "support/mixed_document.h"
#include "support/mixed_meshes.h"
#include "support/says.h"
#include "support/scratch_folder.h"

namespace trismooth::quadrilaterals_test {

using mixed_meshes::MixedMesh;

std::vector<double> xy_of(const MeshDocument& document) {
  std::vector<double> xy;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    xy.insert(xy.end(), {document.points[3 * v], document.points[3 * v + 1]});
  }
  return xy;
}

/// The smallest shape of the elements of that many corners, by the definition.
double smallest_shape(const MixedMesh& mesh, const std::vector<double>& xy, std::size_t corners) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.corners(e).size() == corners) {
      smallest = std::min(smallest, mixed_meshes::shape_by_definition(mesh, e, xy));
    }
  }
  return smallest;
}

PipelineOptions options_of(Method method) {
  PipelineOptions options;
  options.smoothing.method = method;
  options.smoothing.threads = 2;
  return options;
}

bool any_says(const std::vector<std::string>& sentences, const std::string& words) {
  return std::ranges::any_of(sentences, [&](const std::string& sentence) { return says(sentence, words); });
}

TEST_CASE("quadrilaterals of every type of cell are elements, and what they hold is smoothed") {
  // Four squares around a vertex, each a cell of another type; pixels list their corners by rows.
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1.3, 1.2, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0, 2, 2, 0};
  constexpr std::uint8_t pixel = 8;
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 4, 3});
  document.cells.append(pixel, std::vector<std::int32_t>{1, 2, 4, 5});
  document.cells.append(cell_type::polygon, std::vector<std::int32_t>{4, 5, 8, 7});
  document.cells.append(cell_type::lagrange_quad, std::vector<std::int32_t>{3, 4, 7, 6});
  const PipelineResult result = smooth_document(document, options_of(Method::smart));
  CHECK(result.input.quadrilaterals == 4);
  CHECK(result.input.triangles == 0);
  CHECK(result.input.free_vertices == 1);
  CHECK(result.before.inverted == 0);
  CHECK(document.points[12] == Approx(1));
  CHECK(document.points[13] == Approx(1));
}

TEST_CASE("a file of every format that holds quadrilaterals is smoothed as its arrays are, and nothing else changes") {
  const ScratchFolder folder;
  const MixedMesh mesh(6, 5, 0.3, 7);
  int formats = 0;
  for (const accepted_files::FormatSample& sample : accepted_files::format_samples()) {
    const auto is_quad = [](const std::vector<std::uint8_t>& group) {
      return std::ranges::count(group, cell_type::quad) > 0;
    };
    if (!sample.cells.empty() && std::ranges::none_of(sample.cells, is_quad)) {
      continue;
    }
    ++formats;
    const std::string extension = "." + std::string(extensions_of(sample.format).front());
    INFO(extension);
    const std::filesystem::path input = folder / ("in" + extension);
    write_mesh(input, document_of(mesh));
    const MeshDocument read = read_mesh(input);
    std::vector<std::array<std::int32_t, 4>> elements;
    for (std::size_t c = 0; c < read.cells.size(); ++c) {
      if (const auto cell = read.cells[c]; cell.size() == 3 || cell.size() == 4) {
        elements.push_back({cell[0], cell[1], cell[2], cell.size() == 4 ? cell[3] : -1});
      }
    }
    REQUIRE(elements.size() == mesh.elements.size());
    PipelineOptions options = options_of(Method::mean_ratio);
    options.input = input;
    options.output = folder / ("out" + extension);
    options.region_arrays = {"none"};  // blocks and sections are of one type
    const PipelineResult result = run_pipeline(options);
    CHECK(result.input.quadrilaterals == std::ranges::count_if(elements, [](const auto& e) { return e[3] >= 0; }));
    CHECK(result.smoothing->moved_vertices > 10);

    // Where few characters are stored the places are others, as near as these can say.
    const MeshDocument written = read_mesh(*options.output);
    CHECK(written.cells.connectivity == read.cells.connectivity);
    CHECK(written.cells.types == read.cells.types);
    if (read.most_coordinate_characters == 0) {
      std::vector<double> xy = xy_of(read);
      SmoothingOptions of_arrays = options.smoothing;
      of_arrays.threads = 1;
      plan(std::ssize(xy) / 2, elements, of_arrays)
          .smooth(xy_points(xy), read.point_type == ScalarType::float32 ? Storage::float32 : Storage::float64);
      CHECK(xy_of(written) == xy);
    }
    // Where nobody may move the file is the one that was read, byte by byte.
    PipelineOptions still = options;
    still.output = folder / ("still" + extension);
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      still.fixed_vertices.push_back(v);
    }
    run_pipeline(still);
    // (XDMF names the file beside it.)
    std::string written_still = bytes_of(*still.output);
    constexpr std::string_view own_name = "still.";
    for (std::size_t at = 0; (at = written_still.find(own_name, at)) != std::string::npos;) {
      written_still.replace(at, own_name.size(), "in.");
    }
    CHECK(written_still == bytes_of(input));
  }
  CHECK(formats >= 14);
}

TEST_CASE("no element of a file with quadrilaterals gets worse, wherever its plane lies") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const MixedMesh mesh = mixed_meshes::random_mesh(seed);
    MeshDocument document = document_of(mesh);
    const bool is_tilted = seed % 3 == 0;
    const auto tilted = [&](std::span<double> points) {
      for (std::size_t v = 0; is_tilted && v < points.size() / 3; ++v) {
        points[3 * v + 2] = 0.5 * points[3 * v] - 0.25 * points[3 * v + 1];
      }
    };
    tilted(document.points);
    // As lengths in that plane, along its own axes.
    const auto in_plane = [&](const MeshDocument& of) {
      std::vector<double> xy = xy_of(of);
      for (std::size_t v = 0; is_tilted && v < xy.size() / 2; ++v) {
        const double x = xy[2 * v];
        const double y = xy[2 * v + 1];
        const double along = std::hypot(1.0, 0.5);
        const double across = -0.125 / along;
        xy[2 * v] = along * x + across * y;
        xy[2 * v + 1] = std::sqrt(1 + 0.0625 - across * across) * y;
      }
      return xy;
    };
    const std::vector<double> before = in_plane(document);
    const PipelineResult result =
        smooth_document(document, options_of(seed % 2 == 0 ? Method::smart : Method::mean_ratio));
    const std::vector<double> after = in_plane(document);
    double worst_before = 1;
    double worst_after = 1;
    std::int64_t spoiled = 0;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const double was = mixed_meshes::shape_by_definition(mesh, e, before);
      const double is = mixed_meshes::shape_by_definition(mesh, e, after);
      worst_before = std::min(worst_before, was);
      worst_after = std::min(worst_after, is);
      spoiled += was > 1e-12 && is <= 0 ? 1 : 0;
    }
    INFO("seed " << seed);
    CHECK(worst_after >= worst_before - 1e-12);
    CHECK(spoiled == 0);
    CHECK(result.after->elements() == std::ssize(mesh.elements));
  }
}

TEST_CASE("held quadrilaterals stay as they are with all their corners, and the triangles are smoothed") {
  const MixedMesh mesh(9, 9, 0.3, 3, 2);
  MeshDocument document = document_of(mesh);
  const std::vector<double> before = document.points;
  PipelineOptions options = options_of(Method::smart);
  options.quads = Quads::hold;
  const PipelineResult result = smooth_document(document, options);
  CHECK(result.smoothing->moved_vertices > 0);
  CHECK(result.input.quadrilaterals == 0);
  CHECK(result.input.other_cells > 0);
  CHECK(any_says(result.notes, "of other types than triangle: not smoothed"));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (const std::int32_t v : mesh.is_triangle(e) ? std::vector<std::int32_t>() : mesh.corners(e)) {
      CHECK(document.points[3 * v] == before[3 * v]);
      CHECK(document.points[3 * v + 1] == before[3 * v + 1]);
    }
  }
}

/// A grid with a straight boundary whose points inside are moved by up to so much.
MixedMesh tangled_inside(double jitter, std::uint64_t thirds) {
  constexpr std::size_t side = 30;
  MixedMesh mesh(side, side, jitter, 9, thirds);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::size_t column = v % (side + 1);
    const std::size_t row = v / (side + 1);
    if (column % side == 0 || row % side == 0) {
      mesh.points[v] = {static_cast<double>(column), static_cast<double>(row)};
    }
  }
  return mesh;
}

TEST_CASE("inverted quadrilaterals of a file are untangled where that is asked for, and told of where it is not") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    for (const double tilt : {0.0, 0.7}) {
      CAPTURE(thirds, tilt);
      const MixedMesh mesh = tangled_inside(0.8, thirds);
      MeshDocument document = document_of(mesh);
      for (std::size_t v = 0; v < document.point_count(); ++v) {
        document.points[3 * v + 2] = tilt * document.points[3 * v];
      }
      PipelineOptions options = options_of(Method::smart);
      options.smoothing.untangle = Untangle::on;
      const PipelineResult result = smooth_document(document, options);
      CHECK(result.before.inverted > 50);
      CHECK(result.after->inverted == 0);
      REQUIRE(result.smoothing->untangling);
      CHECK(result.smoothing->untangling->inverted_before >= result.before.inverted);
      CHECK(result.smoothing->untangling->inverted_after == 0);
      CHECK((tilt > 0 || smallest_shape(mesh, xy_of(document), 4) > 0));
      CHECK_FALSE(any_says(result.warnings, "inverted"));
    }
  }
  // A corner of held vertices.
  MixedMesh mesh = tangled_inside(0.2, 0);
  mesh.points[2 * 31 + 2] = {2.8, 2.8};
  for (const bool untangles : {false, true}) {
    MeshDocument document = document_of(mesh);
    PipelineOptions options = options_of(Method::smart);
    options.smoothing.untangle = untangles ? Untangle::on : Untangle::off;
    options.fixed_vertices = {2 * 31 + 2, 2 * 31 + 3, 3 * 31 + 2};
    const PipelineResult result = smooth_document(document, options);
    CHECK(result.after->inverted == 1);
    CHECK(any_says(result.warnings, untangles ? "what held vertices fold nothing mends" : "--untangle on mends"));
  }
}

TEST_CASE("a file in which most quadrilaterals are inverted is turned over, wherever its plane lies") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    for (const double tilt : {0.0, 0.7}) {
      CAPTURE(thirds, tilt);
      const MixedMesh mesh = tangled_inside(0.2, thirds);
      MeshDocument document = document_of(mesh);
      for (std::size_t v = 0; v < document.point_count(); ++v) {
        double& x = document.points[3 * v];
        const double y = document.points[3 * v + 1];
        x = x == 0 || x == 30 || y == 0 || y == 30 ? x : 30 - x;
        document.points[3 * v + 2] = tilt * x;
      }
      PipelineOptions options = options_of(Method::mean_ratio);
      const PipelineResult result = smooth_document(document, options);
      CHECK(result.smoothing->untangling->turned_components == 1);
      CHECK(result.before.inverted > 0);
      CHECK(result.after->inverted == 0);
      CHECK(smallest_shape(mesh, xy_of(document), 4) > 0);
    }
  }
}

TEST_CASE("quadrilaterals are smoothed to the same bits by halfedges, which a stage of the program's own has") {
  for (const std::uint64_t thirds : {0, 1}) {
    const MixedMesh mesh(9, 7, 0.3, 21, thirds);
    MeshDocument by_list = document_of(mesh);
    PipelineOptions options = options_of(Method::mean_ratio);
    options.smoothing.topology = Topology::host;
    const PipelineResult expected = smooth_document(by_list, options);
    CHECK(expected.smoothing->moved_vertices > 0);
    MeshDocument by_halfedges = document_of(mesh);
    options.smoothing.topology = Topology::halfedge;
    const PipelineResult result = smooth_document(by_halfedges, options);
    CHECK(result.topology == Topology::halfedge);
    CHECK(result.notes == expected.notes);
    CHECK(by_halfedges.points == by_list.points);

    std::size_t faces_of_four = 0;
    std::int32_t held = -1;
    options.halfedge_stage = [&](HalfedgeStage& stage) {
      for (const auto face : stage.mesh.faces()) {
        faces_of_four += stage.mesh.valence(face) == 4 ? 1 : 0;
      }
      for (const auto vertex : stage.mesh.vertices()) {
        held = stage.mesh.is_boundary(vertex) ? held : stage.point_of(vertex);
      }
      stage.fixed.assign(stage.document.point_count(), 0);
      stage.fixed[static_cast<std::size_t>(held)] = 1;
    };
    MeshDocument by_stage = document_of(mesh);
    const PipelineResult staged = smooth_document(by_stage, options);
    CHECK(static_cast<std::int64_t>(faces_of_four) == expected.before.quadrilaterals);
    CHECK(faces_of_four > 0);
    CHECK(staged.input.free_vertices == expected.input.free_vertices - 1);
    const std::vector<double> before = document_of(mesh).points;
    for (std::size_t k = 3 * static_cast<std::size_t>(held); k < 3 * static_cast<std::size_t>(held) + 3; ++k) {
      CHECK(by_stage.points[k] == before[k]);
    }
  }
}

TEST_CASE("what cannot be had with quadrilaterals holds them or is refused, in a sentence that names the way out") {
  const MixedMesh mesh(6, 6, 0.2, 5);
  MeshDocument document = document_of(mesh);
  const auto notes_with = [&](const std::function<void(PipelineOptions&)>& ask) {
    MeshDocument own = document;
    PipelineOptions options = options_of(Method::smart);
    ask(options);
    return smooth_document(own, options).notes;
  };
  const fakes::FakeBackend backend;
  CHECK(any_says(notes_with([&](PipelineOptions& o) { o.smoothing.backend = &backend; }), "smooths triangles alone"));
  // Asked for, they are held without more words.
  CHECK_FALSE(any_says(notes_with([&](PipelineOptions& o) {
                         o.smoothing.backend = &backend;
                         o.quads = Quads::hold;
                       }),
                       "smooths triangles alone"));
  MeshDocument alone = document_of(MixedMesh(3, 3, 0.1, 1, 0));
  PipelineOptions held;
  held.quads = Quads::hold;
  CHECK(says(message_of<ReadError>([&] { check_document(alone, held); }), "--quads smooth"));
  // A strip whose ends meet turned over.
  MixedMesh strip(6, 1, 0.1, 1, 0);
  strip.elements.push_back({6, 7, 0, 13});
  MeshDocument one_sided = document_of(strip);
  const std::string refused = message_of<ReadError>([&] { check_document(one_sided, {}); });
  CHECK(says(refused, "one-sided surface"));
  CHECK(says(refused, "--quads hold"));
}

TEST_CASE("reports and gates are of the elements of both kinds, and of each alone") {
  const MixedMesh mesh(8, 8, 0.3, 11);
  MeshDocument document = document_of(mesh);
  const QualityReport report = check_document(document, {}).before;
  const std::vector<double> xy = mesh.xy();
  const double of_triangles = smallest_shape(mesh, xy, 3);
  const double of_quadrilaterals = smallest_shape(mesh, xy, 4);
  CHECK(gate_value("triangle.min_shape", report) == Approx(of_triangles));
  CHECK(gate_value("quadrilateral.min_shape", report) == Approx(of_quadrilaterals));
  CHECK(gate_value("min_shape", report) == Approx(std::min(of_triangles, of_quadrilaterals)));
  CHECK(gate_value("quadrilaterals", report) + gate_value("triangles", report) ==
        static_cast<double>(mesh.elements.size()));
  CHECK(gate_value("quadrilateral.max_taper", report) > 0);
  CHECK(gate_value("max_taper", report) == gate_value("quadrilateral.max_taper", report));
  CHECK(gate_value("quadrilateral.inverted", report) + gate_value("triangle.inverted", report) ==
        gate_value("inverted", report));
  for (const std::string& name : gate_names()) {
    CHECK_NOTHROW(gate_value(name, report));
  }
  MeshDocument squares = document_of(MixedMesh(3, 3, 0.1, 1, 0));
  const QualityReport of_squares = check_document(squares, {}).before;
  CHECK(std::isnan(gate_value("triangle.min_shape", of_squares)));
  CHECK_FALSE(check_gate(parse_gate("triangle.min_shape>=0"), of_squares).passed);
  CHECK_THROWS_AS(parse_gate("triangle.triangles>=1"), std::invalid_argument);
  CHECK_THROWS_AS(parse_gate("quadrilateral.min_radius_ratio>=0"), std::invalid_argument);
  CHECK_THROWS_AS(parse_gate("triangle.max_taper<=1"), std::invalid_argument);
}

TEST_CASE(
    "quadrilaterals between two regions, listed twice, and in two parts that nearly touch are taken as triangles are") {
  const MixedMesh mesh(8, 4, 0.2, 9, 0);
  MeshDocument document = document_of(mesh);
  std::vector<std::int32_t> regions;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    regions.push_back(e % 8 < 4 ? 1 : 2);
  }
  document.cell_arrays = {make_data_array("region", 1, regions)};
  const std::vector<double> before = document.points;
  const PipelineResult result = smooth_document(document, options_of(Method::laplacian));
  CHECK(result.input.regions == 2);
  for (std::size_t v = 4; v < document.point_count(); v += 9) {
    CHECK(document.points[3 * v] == before[3 * v]);
  }
  REQUIRE(result.regions_before.size() == 2);
  CHECK(result.regions_before[0].quadrilaterals == 16);
  CHECK(result.regions_before[0].triangles == 0);

  MeshDocument twice = document_of(mesh);
  twice.cells.append(cell_type::quad, std::vector<std::int32_t>{1, 0, 9, 10});
  const PipelineResult once = smooth_document(twice, options_of(Method::smart));
  CHECK(once.before.quadrilaterals == std::ssize(mesh.elements));
  CHECK(any_says(once.notes, "1 element is listed again"));

  // The same grid, each square with corners of its own.
  MeshDocument apart;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    std::vector<std::int32_t> own;
    for (const std::int32_t v : mesh.corners(e)) {
      own.push_back(static_cast<std::int32_t>(apart.point_count()));
      apart.points.insert(apart.points.end(), {mesh.points[v][0], mesh.points[v][1], 0});
    }
    apart.cells.append(cell_type::quad, own);
  }
  MeshDocument joined = apart;
  CHECK(any_says(smooth_document(apart, options_of(Method::smart)).notes, "--merge 0 joins them"));
  PipelineOptions merging = options_of(Method::smart);
  merging.merge = 0;
  CHECK(smooth_document(joined, merging).input.free_vertices == 7 * 3);
}

TEST_CASE("a linear field keeps its plane where quadrilaterals move, and sizes asked for are gone for") {
  const MixedMesh mesh(10, 10, 0.3, 21);
  MeshDocument document = document_of(mesh);
  std::vector<double> values;
  for (const auto& [x, y] : mesh.points) {
    values.push_back(2 * x - 3 * y + 1);
  }
  document.point_arrays = {make_data_array("load", 1, values)};
  PipelineOptions options = options_of(Method::mean_ratio);
  options.fields = Fields::interpolate;
  CHECK(smooth_document(document, options).smoothing->moved_vertices > 20);
  const auto now = find_array(document.point_arrays, "load")->as<double>();
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    CHECK(now[v] == Approx(2 * document.points[3 * v] - 3 * document.points[3 * v + 1] + 1).margin(1e-9));
  }

  MeshDocument sized = document_of(MixedMesh(12, 12, 0.05, 2, 0));
  std::vector<double> lengths;
  for (std::size_t v = 0; v < sized.point_count(); ++v) {
    lengths.push_back(sized.points[3 * v] < 6 ? 1 : 2);
  }
  sized.point_arrays = {make_data_array("size", 1, lengths)};
  PipelineOptions by_size = options_of(Method::mean_ratio);
  by_size.size_array = "size";
  const PipelineResult fit = smooth_document(sized, by_size);
  CHECK(fit.size_fit_after->rms_log_ratio < 0.95 * fit.size_fit_before->rms_log_ratio);
}

TEST_CASE("annotations have the metrics of both kinds of cells") {
  const ScratchFolder folder;
  const MixedMesh mesh(5, 5, 0.3, 17);
  write_mesh(folder / "in.vtk", document_of(mesh));
  PipelineOptions options;
  options.input = folder / "in.vtk";
  options.annotated = folder / "out.vtk";
  options.annotated_metrics = {Metric::shape, Metric::taper};
  run_pipeline(options);
  const MeshDocument annotated = read_mesh(folder / "out.vtk");
  const auto shapes = find_array(annotated.cell_arrays, "trismooth:shape")->as<double>();
  const auto tapers = find_array(annotated.cell_arrays, "trismooth:taper")->as<double>();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    CHECK(shapes[e] == Approx(mixed_meshes::shape_by_definition(mesh, e, mesh.xy())));
    CHECK(std::isnan(tapers[e]) == mesh.is_triangle(e));
  }
}

TEST_CASE("named sides of quadrilaterals hold their vertices") {
  MeshDocument document = document_of(MixedMesh(4, 4, 0.1, 3, 0));
  // The fourth bit is the side from the first corner to the last one: the left side of the square in the middle.
  std::vector<std::int32_t> bits(16, 0);
  bits[10] = 8;
  document.cell_arrays = {make_data_array("skfem:b:crack", 1, bits)};
  const std::vector<double> before = document.points;
  const PipelineResult result = smooth_document(document, options_of(Method::laplacian));
  CHECK(result.input.free_vertices == 7);
  for (const std::size_t v : {12, 17}) {
    CHECK(document.points[3 * v] == before[3 * v]);
  }
}

TEST_CASE("quadrilaterals of eight nodes are smoothed, their middles follow, and the report counts them") {
  MeshDocument document = document_of(MixedMesh(6, 6, 0.25, 3, 0));
  const MeshDocument corners = document;
  document.cells = {};
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  for (std::size_t cell = 0; cell < corners.cells.size(); ++cell) {
    std::vector<std::int32_t> nodes(corners.cells[cell].begin(), corners.cells[cell].end());
    for (std::size_t i = 0; i < 4; ++i) {
      const auto edge = std::minmax(nodes[i], nodes[(i + 1) % 4]);
      const auto [found, is_new] = middles.emplace(edge, static_cast<std::int32_t>(document.point_count()));
      for (std::size_t axis = 0; is_new && axis < 3; ++axis) {
        document.points.push_back((document.points[3 * static_cast<std::size_t>(edge.first) + axis] +
                                   document.points[3 * static_cast<std::size_t>(edge.second) + axis]) /
                                  2);
      }
      nodes.push_back(found->second);
    }
    document.cells.append(cell_type::quadratic_quad, nodes);
  }
  const MeshDocument before = document;
  const PipelineResult result = smooth_document(document, options_of(Method::smart));
  CHECK(result.input.quadratic_quadrilaterals == 36);
  CHECK(result.input.quadratic_triangles == 0);
  CHECK(result.input.middle_nodes == 84);
  CHECK(result.smoothing->moved_vertices > 15);
  REQUIRE(result.quadratic_after);
  CHECK(result.quadratic_after->quadrilaterals == 36);
  CHECK(result.quadratic_after->invalid == 0);
  for (const auto& [edge, middle] : middles) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto at = [&](std::int32_t v) { return document.points[3 * static_cast<std::size_t>(v) + axis]; };
      REQUIRE(at(middle) == Approx((at(edge.first) + at(edge.second)) / 2).margin(1e-14));
    }
  }
  document = before;
  PipelineOptions held = options_of(Method::smart);
  held.quads = Quads::hold;
  CHECK_THROWS_AS(smooth_document(document, held), ReadError);
}

}  // namespace trismooth::quadrilaterals_test
