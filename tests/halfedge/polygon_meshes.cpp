// SPDX-License-Identifier: BSD-3-Clause
// smooth(mesh), plan(mesh) and quality(mesh) of meshes with faces of more than three sides.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/hold.h"
#include "trismooth/mesh_io/halfedge/mesh_quality.h"
#include "trismooth/mesh_io/halfedge/smooth_mesh.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/fake_backend.h"
#include "support/mixed_meshes.h"
#include "support/own_meshes.h"
#include "support/polygon_drawings.h"

namespace own_meshes::polygons {

using mixed_meshes::MixedMesh;
using trismooth::Form;
using trismooth::Method;
using trismooth::QualityReport;
using trismooth::SmoothingOptions;
using trismooth::SmoothingResult;
namespace hold = trismooth::hold;

std::int64_t count_quadrilaterals(const Flat& flat) {
  return std::ranges::count_if(flat.elements, [](const auto& element) { return element[3] >= 0; });
}

void check_same(const SmoothingResult& result, const SmoothingResult& expected) {
  CHECK(result.sweeps == expected.sweeps);
  CHECK(result.stop_reason == expected.stop_reason);
  CHECK(result.vertex_updates == expected.vertex_updates);
  CHECK(result.moved_vertices == expected.moved_vertices);
  CHECK(result.reverted_vertices == expected.reverted_vertices);
  CHECK(result.free_vertices == expected.free_vertices);
  CHECK(result.quadrilaterals == expected.quadrilaterals);
  CHECK(result.inverted == expected.inverted);
  CHECK(result.degenerate == expected.degenerate);
  CHECK(result.layers.kept == expected.layers.kept);
}

/// The shapes of all elements, by their definition, of x and y one behind the other.
std::vector<double> shapes_of(const Flat& flat, const std::vector<double>& xy) {
  MixedMesh mesh;
  mesh.elements = flat.elements;
  std::vector<double> shapes;
  for (std::size_t e = 0; e < flat.elements.size(); ++e) {
    shapes.push_back(mixed_meshes::shape_by_definition(mesh, e, xy));
  }
  return shapes;
}

/// No element that was valid is not any more, and the worst one is no worse but for rounding.
void check_no_worse(const std::vector<double>& before, const std::vector<double>& after, double rounding) {
  CHECK(*std::ranges::min_element(after) >= *std::ranges::min_element(before) - rounding);
  for (std::size_t e = 0; e < before.size(); ++e) {
    if (before[e] > rounding) {
      CHECK(after[e] > 0);
    }
  }
}

/// Places along the two axes of tilted().
template <class Mesh>
std::vector<double> in_tilted_plane(const Mesh& mesh) {
  std::vector<double> xy;
  for (const auto v : mesh.all_vertices()) {
    const auto& p = mesh.point(v);
    xy.push_back(0.48 * (p[0] - 3) + 0.64 * (p[1] + 5) + 0.6 * (p[2] - 1));
    xy.push_back(-0.8 * (p[0] - 3) + 0.6 * (p[1] + 5));
  }
  return xy;
}

SmoothingOptions random_options(std::uint64_t seed) {
  constexpr std::array methods{Method::smart, Method::laplacian, Method::weighted, Method::mean_ratio};
  SmoothingOptions options;
  options.method = methods[seed % 4];
  options.form = seed % 3 == 0 ? Form::swap : Form::in_place;
  options.precision = seed % 7 == 0 ? trismooth::Precision::single_precision : trismooth::Precision::double_precision;
  options.untangle = seed % 5 == 0 ? trismooth::Untangle::on : trismooth::Untangle::automatic;
  options.max_sweeps = 40;
  return options;
}

TEMPLATE_TEST_CASE("faces of three and four sides are smoothed to the bits of flat arrays, corners of others are held",
                   "", PolyMesh, FullPolyMesh, PairPolyMesh, EigenPolyMesh, NodePolyMesh) {
  std::int64_t quadrilaterals = 0;
  std::int64_t triangles = 0;
  unsigned met = 0;  // reasons
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    auto mesh = mesh_of<TestType>(random_drawing(seed));
    const auto before = mesh;
    const Flat flat = flat_of(mesh);
    const SmoothingOptions options = random_options(seed);
    const trismooth::Constraints constraints{.other_cells = flat.other_cells};
    auto xy = xy_in(mesh);
    const auto n = static_cast<std::int64_t>(mesh.n_vertices());
    const std::vector<std::uint8_t> reasons = trismooth::plan(n, flat.elements, constraints, options).fixed();
    const SmoothingResult expected = trismooth::smooth(trismooth::xy_points(xy), flat.elements, constraints, options);
    CHECK(trismooth::plan(mesh, options).fixed() == reasons);
    check_same(trismooth::smooth(mesh, options), expected);
    CHECK(xy_in(mesh) == xy);
    for (const auto v : mesh.vertices()) {
      const auto i = static_cast<std::size_t>(v.idx());
      met |= reasons[i];
      if constexpr (numbers_of<TestType> == 3) {
        CHECK(mesh.point(v)[2] == before.point(v)[2]);
      }
      if (flat.other_cells[i] != 0) {
        CHECK((reasons[i] & hold::other_cell) != 0);
        CHECK(mesh.point(v)[0] == before.point(v)[0]);
        CHECK(mesh.point(v)[1] == before.point(v)[1]);
      }
    }
    quadrilaterals += count_quadrilaterals(flat);
    triangles += std::ssize(flat.elements) - count_quadrilaterals(flat);
  }
  CHECK(quadrilaterals > 300);
  CHECK(triangles > 300);
  CHECK((met & (hold::bow_tie | hold::other_cell | hold::boundary)) ==
        (hold::bow_tie | hold::other_cell | hold::boundary));
}

TEST_CASE("no mesh with polygons comes back worse, in whatever plane, by any method") {
  const bool is_tilted = GENERATE(false, true);
  std::int64_t moved = 0;
  for (std::uint64_t seed = 100; seed < 160; ++seed) {
    CAPTURE(seed);
    auto mesh = mesh_of<FullPolyMesh>(random_drawing(seed), is_tilted);
    const auto before = mesh;
    const Flat flat = flat_of(mesh);
    SmoothingOptions options = random_options(seed);
    options.untangle = trismooth::Untangle::off;
    const SmoothingResult result = trismooth::smooth(mesh, options);
    moved += result.moved_vertices;
    CHECK(result.quadrilaterals == count_quadrilaterals(flat));
    const auto places = [&](const FullPolyMesh& of) { return is_tilted ? in_tilted_plane(of) : xy_in(of); };
    check_no_worse(shapes_of(flat, places(before)), shapes_of(flat, places(mesh)), 1e-12);
    for (const auto v : mesh.vertices()) {
      const auto step = mesh.point(v) - before.point(v);
      CHECK(std::abs(is_tilted ? -0.36 * step[0] - 0.48 * step[1] + 0.8 * step[2] : step[2]) < 1e-12);
      if (mesh.is_boundary(v) || flat.other_cells[static_cast<std::size_t>(v.idx())] != 0) {
        CHECK(mesh.point(v) == before.point(v));
      }
    }
  }
  CHECK(moved > 500);
}

TEST_CASE("a tilted mesh with polygons is smoothed like the flat one, to rounding") {
  const Drawing drawing = grid_drawing(10, 3);
  SmoothingOptions options;
  options.method = GENERATE(Method::laplacian, Method::mean_ratio);
  options.max_sweeps = 15;
  auto flat = mesh_of<FullPolyMesh>(drawing);
  auto tilted_one = mesh_of<FullPolyMesh>(drawing, true);
  const SmoothingResult expected = trismooth::smooth(flat, options);
  const SmoothingResult result = trismooth::smooth(tilted_one, options);
  CHECK(result.free_vertices == expected.free_vertices);
  CHECK(result.quadrilaterals == expected.quadrilaterals);
  const std::vector<double> xy = xy_in(flat);
  const std::vector<double> other = in_tilted_plane(tilted_one);
  for (std::size_t i = 0; i < xy.size(); ++i) {
    CHECK(other[i] == Approx(xy[i]).margin(1e-11));
  }
}

TEST_CASE("constraints, target lengths and lines to slide on are those of flat arrays in meshes with polygons") {
  const auto along = GENERATE(trismooth::Slide::off, trismooth::Slide::straight, trismooth::Slide::curves);
  for (std::uint64_t seed = 200; seed < 212; ++seed) {
    CAPTURE(seed);
    auto mesh = mesh_of<FullPolyMesh>(grid_drawing(9, seed));
    const Flat flat = flat_of(mesh);
    OpenMesh::FPropHandleT<int> material;
    mesh.add_property(material, "material");
    for (const auto f : mesh.faces()) {
      double x = 0;
      for (const auto v : mesh.fv_range(f)) {
        x += mesh.point(v)[0] / mesh.valence(f);
      }
      mesh.property(material, f) = x < 4.5 ? 7 : -1;
    }
    std::vector<std::int32_t> regions;
    for (const int f : flat.faces) {
      regions.push_back(mesh.property(material, OpenMesh::FaceHandle(f)));
    }
    std::vector<std::uint8_t> fixed(mesh.n_vertices(), 0);
    std::vector<std::uint8_t> other_cells = flat.other_cells;
    std::vector<std::uint8_t> others_named(mesh.n_vertices(), 0);
    std::vector<double> lengths(mesh.n_vertices());
    for (std::size_t v = 0; v < fixed.size(); ++v) {
      fixed[v] = v % 11 == 3 ? 1 : 0;
      others_named[v] = v % 17 == 5 ? 1 : 0;
      other_cells[v] |= others_named[v];
      lengths[v] = 0.8 + 0.05 * static_cast<double>(v % 9);
    }
    const std::vector<std::int32_t> ids{20, 20, 31};
    SmoothingOptions options = random_options(seed);
    options.precision = trismooth::Precision::double_precision;
    if (options.method == Method::mean_ratio) {
      options.mean_ratio.target_lengths = lengths;
    }
    std::vector<double> xy = xy_in(mesh);
    const SmoothingResult expected = trismooth::smooth(
        trismooth::xy_points(xy), flat.elements,
        {.fixed = fixed, .fixed_ids = ids, .other_cells = other_cells, .regions = regions, .slide = {.along = along}},
        options);
    const SmoothingResult result = trismooth::smooth(mesh,
                                                     {.fixed = [&](auto v) { return v.idx() % 11 == 3; },
                                                      .fixed_ids = ids,
                                                      .other_cells = others_named,
                                                      .regions = "material",
                                                      .slide = {.along = along}},
                                                     options);
    check_same(result, expected);
    CHECK(xy_in(mesh) == xy);
    CHECK(result.moved_vertices > 0);
    CHECK(result.sliding.has_value() == expected.sliding.has_value());
    if (result.sliding && expected.sliding) {
      CHECK(result.sliding->slid == expected.sliding->slid);
    }
  }
}

TEST_CASE("deleted faces of any sides are passed over, and corners of locked ones are held") {
  const bool is_tilted = GENERATE(false, true);
  for (std::uint64_t seed = 300; seed < 312; ++seed) {
    CAPTURE(seed);
    Drawing drawing = grid_drawing(9, seed);
    auto mesh = mesh_of<FullPolyMesh>(drawing, is_tilted);
    std::vector<std::uint8_t> held(mesh.n_vertices(), 0);
    std::mt19937_64 random(seed);
    std::vector<Corners> kept;
    for (std::size_t f = 0; f < drawing.faces.size(); ++f) {
      const OpenMesh::FaceHandle face(static_cast<int>(f));
      const auto kind = random() % 12;
      if (kind == 0) {
        mesh.delete_face(face, false);
        mesh.status(face).set_locked(true);  // it is gone with its marks
        continue;
      }
      kept.push_back(drawing.faces[f]);
      if (kind == 1) {
        mesh.status(face).set_locked(true);
        for (const std::int32_t corner : drawing.faces[f]) {
          held[static_cast<std::size_t>(corner)] = 1;
        }
      }
    }
    drawing.faces = kept;
    auto never = mesh_of<FullPolyMesh>(drawing, is_tilted);  // never had the others
    for (const auto v : never.all_vertices()) {
      if (never.is_isolated(v)) {
        mesh.point(v) = OpenMesh::Vec3d(std::numeric_limits<double>::quiet_NaN());
        never.point(v) = {7e100, 0, 0};
      }
    }
    SmoothingOptions options = random_options(seed);
    const std::vector<std::uint8_t> reasons = trismooth::plan(mesh, options).fixed();
    for (std::size_t v = 0; v < held.size(); ++v) {
      CHECK(((reasons[v] & hold::named) != 0) == (held[v] != 0));
    }
    check_same(trismooth::smooth(mesh, options), trismooth::smooth(never, {.fixed = held}, options));
    for (const auto v : never.all_vertices()) {
      if (!never.is_isolated(v)) {
        CHECK(mesh.point(v) == never.point(v));
      }
    }
  }
}

TEST_CASE("a plan of a mesh with polygons smooths as smooth() does, and takes no mesh whose faces are others") {
  const bool is_tilted = GENERATE(false, true);
  const Drawing drawing = grid_drawing(8, 5);
  auto mesh = mesh_of<FullPolyMesh>(drawing, is_tilted);
  auto plan = trismooth::plan(mesh);
  for (int step = 0; step < 3; ++step) {
    for (const auto v : mesh.vertices()) {
      if (!mesh.is_boundary(v)) {
        mesh.point(v) += 0.2 * std::sin(v.idx() + step) *
                         OpenMesh::Vec3d(is_tilted ? 0.48 : 1, is_tilted ? 0.64 : 0, is_tilted ? 0.6 : 0);
      }
    }
    auto other = mesh;
    check_same(plan.smooth(mesh), trismooth::smooth(other));
    CHECK(numbers_in(mesh) == numbers_in(other));
  }
  // As many vertices and faces, and one side elsewhere: a hexagon cut in two.
  const std::vector<double> hexagon{2, 0, 0, 1, 2, 0, -1, 2, 0, -2, 0, 0, -1, -2, 0, 1, -2, 0};
  const std::array<std::vector<Corners>, 3> cuts{
      {{{0, 1, 2}, {0, 2, 3, 4, 5}}, {{0, 1, 2, 3}, {0, 3, 4, 5}}, {{0, 1, 2, 3, 4}, {0, 4, 5}}}};
  for (std::size_t of_plan = 0; of_plan < cuts.size(); ++of_plan) {
    auto hexagon_plan = trismooth::plan(mesh_of<PolyMesh>(Drawing{hexagon, cuts[of_plan]}));
    for (std::size_t cut = 0; cut < cuts.size(); ++cut) {
      auto cut_mesh = mesh_of<PolyMesh>(Drawing{hexagon, cuts[cut]});
      const std::string error = error_of([&] { hexagon_plan.smooth(cut_mesh); });
      CHECK(error.starts_with("the mesh has other faces") == (cut != of_plan));
    }
  }
}

TEST_CASE("what has been turned over of a mesh with polygons is told by face") {
  Drawing drawing = with_joined_faces(MixedMesh(12, 12, 0.1, 4), 4, 4);
  auto mesh = mesh_of<FullPolyMesh>(drawing);
  const Flat flat = flat_of(mesh);
  for (const auto v : mesh.vertices()) {
    if (!mesh.is_boundary(v) && flat.other_cells[static_cast<std::size_t>(v.idx())] == 0) {
      mesh.point(v)[0] = 12 - mesh.point(v)[0];
    }
  }
  SmoothingOptions options;
  options.untangle = trismooth::Untangle::on;
  std::vector<double> xy = xy_in(mesh);
  const SmoothingResult expected = trismooth::smooth(trismooth::xy_points(xy), flat.elements,
                                                     trismooth::Constraints{.other_cells = flat.other_cells}, options);
  const SmoothingResult result = trismooth::smooth(mesh, options);
  CHECK(xy_in(mesh) == xy);
  REQUIRE(result.untangling);
  REQUIRE(expected.untangling);
  CHECK(result.untangling->inverted_after == expected.untangling->inverted_after);
  REQUIRE(expected.untangling->turned_components > 0);
  std::vector<std::uint8_t> turned(mesh.n_faces(), 0);
  for (std::size_t e = 0; e < flat.faces.size(); ++e) {
    turned[static_cast<std::size_t>(flat.faces[e])] = expected.untangling->turned[e];
  }
  CHECK(result.untangling->turned == turned);
}

TEST_CASE("the quality of a mesh with polygons is that of its triangles and quadrilaterals, by their faces") {
  for (std::uint64_t seed = 400; seed < 420; ++seed) {
    CAPTURE(seed);
    const Drawing drawing = random_drawing(seed);
    const auto mesh = mesh_of<FullPolyMesh>(drawing);
    const Flat flat = flat_of(mesh);
    const std::vector<double> xy = xy_in(mesh);
    const QualityReport expected = trismooth::quality(trismooth::xy_points(xy), flat.elements);
    const QualityReport report = trismooth::quality(mesh);
    const QualityReport in_space = trismooth::quality(mesh_of<FullPolyMesh>(drawing, true));
    CHECK(report.quadrilaterals == expected.quadrilaterals);
    CHECK(report.triangles == expected.triangles);
    CHECK(report.inverted == expected.inverted);
    CHECK(in_space.elements() == expected.elements());
    REQUIRE(report.kinds.size() == expected.kinds.size());
    const std::vector<double> shapes = shapes_of(flat, xy);
    const auto& shape = report[trismooth::Metric::shape];
    CHECK(shape.mean == expected[trismooth::Metric::shape].mean);
    CHECK(shape.min == Approx(*std::ranges::min_element(shapes)).margin(1e-12));
    CHECK(in_space[trismooth::Metric::shape].mean == Approx(shape.mean).epsilon(1e-9));
    for (std::size_t i = 0; i < report.worst.size(); ++i) {
      const auto e = static_cast<std::size_t>(expected.worst[i].element);
      CHECK(report.worst[i].element == flat.faces[e]);
      CHECK(report.worst[i].shape == Approx(shapes[e]).margin(1e-12));
    }
  }
}

TEST_CASE("faces of five sides alone hold all, and cut into triangles let go") {
  // A pentagon within a ring of five quadrilaterals.
  Drawing drawing;
  for (int ring = 1; ring <= 3; ++ring) {
    for (int i = 0; i < 5; ++i) {
      const double angle = 1.2566 * i;
      drawing.xyz.insert(drawing.xyz.end(),
                         {ring * std::cos(angle) + (ring == 2 && i == 0 ? 0.6 : 0), ring * std::sin(angle), 0});
    }
  }
  drawing.faces = {{0, 1, 2, 3, 4}};
  auto alone = mesh_of<PolyMesh>(drawing);
  CHECK(trismooth::smooth(alone).moved_vertices == 0);
  CHECK(trismooth::plan(alone).fixed()[0] == (hold::other_cell | hold::isolated));
  CHECK(trismooth::quality(alone).elements() == 0);
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < 5; ++i) {
      const int a = 5 * ring + i;
      const int b = 5 * ring + (i + 1) % 5;
      drawing.faces.push_back({a, a + 5, b + 5, b});
    }
  }
  auto mesh = mesh_of<PolyMesh>(drawing);
  const auto free_of = [](const PolyMesh& of) {
    const auto reasons = trismooth::plan(of).fixed();
    return std::ranges::count(reasons, 0);
  };
  CHECK(free_of(mesh) == 5);
  CHECK(trismooth::smooth(mesh).moved_vertices > 0);
  mesh.triangulate(OpenMesh::FaceHandle(0));
  CHECK(free_of(mesh) == 10);
}

/// One that smooths triangles alone.
class TrianglesAlone final : public trismooth::Backend {
 public:
  std::string name() const override { return "odd"; }
  bool takes_quadrilaterals() const override { return false; }
  std::unique_ptr<trismooth::PreparedSmoother> prepare(trismooth::MeshRings mesh,
                                                       const trismooth::ElementList& elements,
                                                       std::span<const trismooth::Point2<double>> local,
                                                       const SmoothingOptions& options) const override {
    if (!elements.are_triangles()) {
      throw std::invalid_argument("odd smooths triangles alone");
    }
    return trismooth::cpu_backend().prepare(std::move(mesh), elements, local, options);
  }
};

TEST_CASE("a backend without quadrilaterals refuses them, of one that finds rings the host finds them and says so") {
  const bool is_tilted = GENERATE(false, true);
  const Drawing drawing = grid_drawing(8, 6);
  auto mesh = mesh_of<FullPolyMesh>(drawing, is_tilted);
  auto by_cpu = mesh;
  trismooth::smooth(by_cpu);
  const auto before = numbers_in(mesh);
  const TrianglesAlone triangles_alone;
  SmoothingOptions options;
  options.backend = &triangles_alone;
  CHECK_THROWS_AS(trismooth::smooth(mesh, options), std::invalid_argument);
  CHECK(error_of([&] { trismooth::smooth(mesh, options); }) == "odd smooths triangles alone");
  CHECK(numbers_in(mesh) == before);

  const fakes::FakeBackend device;
  options.backend = &device;
  options.topology = trismooth::Topology::device;
  const SmoothingResult result = trismooth::smooth(mesh, options);
  CHECK(result.backend == "cuda");
  CHECK(result.backend_note.find("of a mesh with quadrilaterals no device does") != std::string::npos);
  CHECK(device.rings_found == 0);
  CHECK(numbers_in(mesh) == numbers_in(by_cpu));
}

TEST_CASE("a face of two sides, and corners of polygons that are no numbers or in no plane, are refused") {
  const Drawing drawing = grid_drawing(6, 7);
  const auto mesh = mesh_of<FullPolyMesh>(drawing);
  auto broken = mesh;
  const auto h = broken.halfedge_handle(OpenMesh::FaceHandle(4));
  broken.set_next_halfedge_handle(broken.next_halfedge_handle(h), h);
  const std::string expected = "face 4 has 2 corners, expected three or more";
  CHECK(error_of([&] { trismooth::smooth(broken); }) == expected);
  CHECK(error_of([&] { static_cast<void>(trismooth::plan(broken)); }) == expected);
  CHECK(error_of([&] { static_cast<void>(trismooth::quality(broken)); }) == expected);
  CHECK(numbers_in(broken) == numbers_in(mesh));

  const Flat flat = flat_of(mesh);
  const auto corner = std::ranges::find(flat.other_cells, 1) - flat.other_cells.begin();
  REQUIRE(corner < std::ssize(flat.other_cells));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 2.0}) {
    auto spoilt = mesh;
    spoilt.point(OpenMesh::VertexHandle(static_cast<int>(corner)))[2] = bad;
    auto smoothed = spoilt;
    CHECK_THROWS_AS(trismooth::smooth(smoothed), trismooth::MeshError);
    CHECK_THROWS_AS(trismooth::quality(spoilt), trismooth::MeshError);
    CHECK(error_of([&] { trismooth::smooth(smoothed); }).find("vertex " + std::to_string(corner) + " ") !=
          std::string::npos);
    smoothed.point(OpenMesh::VertexHandle(static_cast<int>(corner)))[2] = 0.25;
    CHECK(numbers_in(smoothed) == numbers_in(mesh));
  }
}

}  // namespace own_meshes::polygons
