// SPDX-License-Identifier: BSD-3-Clause
// Sliding from file to file.

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/report/text_report.h"

#include "catch.h"
#include "support/scratch_folder.h"
#include "support/sliding_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::sliding_test {

constexpr int side = 8;

/// A square of side x side nodes off their places, with line elements on its sides (a group each, the left one linked
/// to the right one) and on row 3 inside, and a point element at node (5, 0). Between the nodes are two triangles, or
/// with `has_quadrilaterals` in two columns of three a quadrilateral.
std::string msh(bool has_quadrilaterals) {
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << side * side << "\n";
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double off_x = i > 0 && i + 1 < side ? 0.2 * ((7 * i + 3 * j) % 5 - 2) / 2 : 0;
      const double off_y = j > 0 && j + 1 < side && j != 3 ? 0.2 * ((5 * (i % (side - 1)) + 4 * j) % 7 - 3) / 3 : 0;
      text << j * side + i + 1 << " " << (i + off_x) / (side - 1) << " " << (j + off_y) / (side - 1) << " 0\n";
    }
  }
  std::ostringstream elements;
  int count = 0;
  const auto line = [&](int group, int a, int b) {
    elements << ++count << " 1 2 " << group << " " << group << " " << a + 1 << " " << b + 1 << "\n";
  };
  for (int i = 0; i + 1 < side; ++i) {
    line(1, i, i + 1);
    line(2, i * side + side - 1, (i + 1) * side + side - 1);
    line(3, (side - 1) * side + i, (side - 1) * side + i + 1);
    line(4, i * side, (i + 1) * side);
    line(5, 3 * side + i, 3 * side + i + 1);
  }
  elements << ++count << " 15 2 9 9 6\n";
  for (int j = 0; j + 1 < side; ++j) {
    for (int i = 0; i + 1 < side; ++i) {
      const int a = j * side + i + 1;
      if (has_quadrilaterals && i % 3 != 1) {
        elements << ++count << " 3 2 10 10 " << a << " " << a + 1 << " " << a + side + 1 << " " << a + side << "\n";
        continue;
      }
      elements << ++count << " 2 2 10 10 " << a << " " << a + 1 << " " << a + side + 1 << "\n";
      elements << ++count << " 2 2 10 10 " << a << " " << a + side + 1 << " " << a + side << "\n";
    }
  }
  text << "$EndNodes\n$Elements\n"
       << count << "\n"
       << elements.str() << "$EndElements\n$Periodic\n1\n1 2 4\n"
       << side << "\n";
  for (int j = 0; j < side; ++j) {
    text << j * side + side << " " << j * side + 1 << "\n";
  }
  text << "$EndPeriodic\n";
  return text.str();
}

struct Smoothed {
  PipelineResult result;
  MeshDocument before, after;

  bool moved(int v) const {
    return !std::equal(before.points.begin() + 3 * v, before.points.begin() + 3 * v + 3, after.points.begin() + 3 * v);
  }
};

Smoothed smoothed(const ScratchFolder& folder, const PipelineOptions& wanted, bool has_quadrilaterals = false) {
  PipelineOptions options = wanted;
  options.input = folder / "square.msh";
  options.output = folder / "smoothed.msh";
  std::ofstream(options.input) << msh(has_quadrilaterals);
  options.smoothing.method = trismooth::Method::mean_ratio;
  Smoothed found;
  found.result = trismooth::run_pipeline(options);
  found.before = trismooth::read_mesh(options.input);
  found.after = trismooth::read_mesh(*options.output);
  return found;
}

TEST_CASE("lines of a file are slid on, its groups end them, points stay, and periodic nodes go together") {
  const ScratchFolder folder;
  PipelineOptions options;
  options.slide.along = Slide::straight;
  const bool has_quadrilaterals = GENERATE(false, true);
  const Smoothed found = smoothed(folder, options, has_quadrilaterals);
  CHECK((found.result.before.quadrilaterals > 0) == has_quadrilaterals);
  REQUIRE(found.result.smoothing->sliding);
  CHECK(found.result.smoothing->sliding->slid > side);
  int slid_inside = 0;
  for (int i = 0; i < side; ++i) {
    const auto y = [](const MeshDocument& document, int v) {
      return document.points[3 * static_cast<std::size_t>(v) + 1];
    };
    CHECK(y(found.after, i) == 0);
    CHECK(y(found.after, 3 * side + i) == y(found.before, 3 * side + i));
    CHECK(y(found.after, i * side) == y(found.after, i * side + side - 1));
    slid_inside += found.moved(3 * side + i) ? 1 : 0;
  }
  CHECK(slid_inside > 2);
  CHECK(found.moved(2));
  CHECK_FALSE(found.moved(5));  // a point element
  REQUIRE(found.result.areas.size() == 1);
  CHECK(found.result.areas[0].before == Approx(1));
  CHECK(std::abs(found.result.areas[0].relative_change()) < 1e-15);
}

TEST_CASE("the report says how many slid, how far lines are off, and what became of areas") {
  PipelineResult result;
  result.smoothing.emplace();
  trismooth::SlidingResult& sliding = result.smoothing->sliding.emplace();
  CHECK(trismooth::sliding_text(result) == "no vertex of a boundary or an interface can slide");
  sliding.chains = 3;
  sliding.vertices = 20;
  sliding.given_up = true;
  CHECK(trismooth::sliding_text(result) ==
        "given up: so many vertices would have gone back for it that nothing slides");
  sliding.given_up = false;
  CHECK(trismooth::sliding_text(result) == "0 of 20 vertices on 3 lines slid");
  sliding.slid = 17;
  result.areas = {{2, 2}, {4, 4}};
  CHECK(trismooth::sliding_text(result) ==
        "17 of 20 vertices on 3 lines slid; lines are where they were; areas are what they were");
  sliding.largest_deviation = 0.25;
  sliding.relative_deviation = 0.01;
  result.areas[1].after = 4.0008;
  CHECK(
      trismooth::sliding_text(result) ==
      "17 of 20 vertices on 3 lines slid; lines are up to 0.25 from where they were, 0.01 of an edge; areas of regions "
      "changed by 0.02 % at most");
}

TEST_CASE("annotations show those that slid as not held") {
  const ScratchFolder folder;
  PipelineOptions options;
  options.slide.along = Slide::straight;
  options.annotate = true;
  const Smoothed found = smoothed(folder, options);
  const auto fixed = std::ranges::find(found.after.point_arrays, "trismooth:fixed", &trismooth::DataArray::name);
  REQUIRE(fixed != found.after.point_arrays.end());
  int slid = 0;
  for (int v = 0; v < side * side; ++v) {
    if (found.moved(v)) {
      CHECK(fixed->value(static_cast<std::size_t>(v)) == 0);
      slid += v < side ? 1 : 0;
    }
  }
  CHECK(slid > 0);
  CHECK(fixed->value(0) == 1);
}

TEST_CASE("nodes of points of Gmsh's geometry stay on a side that slides") {
  // Two rows of nodes, uneven on both sides; node 4 is on a point of the geometry, the others on its surface.
  const ScratchFolder folder;
  std::ofstream(folder / "strip.msh") << R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
2 10 1 10
0 1 0 1
4
0.9 0 0
2 1 0 9
1
2
3
5
6
7
8
9
10
0 0 0
0.1 0 0
0.8 0 0
2 0 0
0 1 0
0.5 1 0
1 1 0
1.9 1 0
2 1 0
$EndNodes
$Elements
1 8 1 8
2 1 2 8
1 1 2 6
2 2 7 6
3 2 3 7
4 3 8 7
5 3 4 8
6 4 9 8
7 4 5 9
8 5 10 9
$EndElements
)";
  PipelineOptions options;
  options.input = folder / "strip.msh";
  options.output = folder / "smoothed.msh";
  options.smoothing.method = trismooth::Method::mean_ratio;
  options.slide.along = Slide::straight;
  const auto x_of = [&](int node) {
    return trismooth::read_mesh(*options.output).points[3 * static_cast<std::size_t>(node)];
  };
  trismooth::run_pipeline(options);
  const MeshDocument before = trismooth::read_mesh(options.input);
  const auto point = static_cast<int>(std::ranges::find(before.points, 0.9) - before.points.begin()) / 3;
  CHECK(x_of(point) == 0.9);
  options.fixed_sets = {"none"};
  trismooth::run_pipeline(options);
  CHECK(x_of(point) != 0.9);
}

TEST_CASE("without --slide lines of a file hold their vertices") {
  const ScratchFolder folder;
  const Smoothed found = smoothed(folder, {});
  CHECK_FALSE(found.result.smoothing->sliding);
  CHECK(found.result.areas.empty());
  for (int i = 0; i < side; ++i) {
    CHECK_FALSE(found.moved(i));
    CHECK_FALSE(found.moved(3 * side + i));
  }
}

TEST_CASE("the same mesh slides to the same bits, whoever builds the program") {
  const ScratchFolder folder;
  PipelineOptions options;
  options.slide.along = Slide::straight;
  CHECK(smoothed(folder, options, true).result.coordinates_hash == 0xa00f8e580660ac91U);
  CHECK(smoothed(folder, options).result.coordinates_hash == 0xb1472465162469a6U);
  MeshDocument bent = trismooth::read_mesh(folder / "square.msh");
  for (std::size_t v = 0; v < bent.point_count(); ++v) {
    bent.points[3 * v + 1] += 0.25 * bent.points[3 * v] * bent.points[3 * v];
  }
  options.slide.along = Slide::curves;
  options.slide.deviation = 0.05;
  options.slide.coincident = true;
  options.smoothing.method = trismooth::Method::mean_ratio;
  CHECK(trismooth::smooth_document(bent, options).coordinates_hash == 0x19e79cad00fb9affU);
}

TEST_CASE("parts that touch without sharing vertices stay together, and a note says so") {
  const sliding_meshes::TwoSquares two(12, 1e-10);
  const MeshDocument before = triangle_document(two.mesh);
  MeshDocument after = before;
  PipelineOptions options;
  options.slide.along = Slide::straight;
  options.smoothing.method = trismooth::Method::mean_ratio;
  const PipelineResult result = trismooth::smooth_document(after, options);
  REQUIRE(result.smoothing->sliding);
  CHECK(result.smoothing->sliding->slid > 0);
  CHECK(std::ranges::count_if(result.notes, [](const std::string& note) {
          return note.starts_with("lines touch without sharing vertices");
        }) == 1);
  const auto is_at = [&](int v) {
    return std::equal(before.points.begin() + 3 * v, before.points.begin() + 3 * v + 3, after.points.begin() + 3 * v);
  };
  for (int j = 0; j < two.side; ++j) {
    CHECK((is_at(two.left_of(j)) && is_at(two.right_of(j))));
  }
}

TEST_CASE("sliding on a map of the sphere is wrong usage") {
  const ScratchFolder folder;
  PipelineOptions options;
  options.slide.along = Slide::straight;
  options.geographic = true;
  CHECK_THROWS_AS(smoothed(folder, options), std::invalid_argument);
}

}  // namespace trismooth::sliding_test
