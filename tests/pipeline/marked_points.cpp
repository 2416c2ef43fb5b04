// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trismooth/pipeline/input/point_sets.h"

#include "catch.h"
#include "support/says.h"

namespace trismooth::marked_points_test {

using Numbers = std::vector<std::int32_t>;
using Marker = std::function<std::int32_t(int x, int y)>;

/// A grid of `side` x `side` points, row by row, whose inner points have the markers of `inside`, the others 1.
struct Grid {
  int side;
  MeshDocument document;
  std::vector<Triangle> triangles;
  Numbers regions{};

  Grid(int points_a_side, const std::string& array, const Marker& inside) : side(points_a_side) {
    document.points.assign(3 * static_cast<std::size_t>(side * side), 0.0);
    Numbers markers;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const bool is_inside = x > 0 && y > 0 && x < side - 1 && y < side - 1;
        markers.push_back(is_inside ? inside(x, y) : 1);
        if (x + 1 < side && y + 1 < side) {
          const std::int32_t a = at(x, y);
          triangles.push_back({a, a + 1, a + side + 1});
          triangles.push_back({a, a + side + 1, a + side});
        }
      }
    }
    document.point_arrays.push_back(trismooth::make_data_array(array, 1, std::move(markers)));
  }

  std::int32_t at(int x, int y) const { return y * side + x; }

  /// Makes regions of what is left and right of a column.
  void divide(int column) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      regions.push_back(static_cast<int>(t / 2) % (side - 1) < column ? 0 : 1);
    }
  }

  HeldSets held(const std::vector<std::string>& names = {}) const {
    return find_held_sets(document, triangles, names, regions);
  }

  Numbers numbers_held() const {
    const HeldSets sets = held();
    Numbers numbers;
    for (std::size_t v = 0; v < sets.flags.size(); ++v) {
      if (sets.flags[v] != 0) {
        numbers.push_back(static_cast<std::int32_t>(v));
      }
    }
    return numbers;
  }

  /// The points inside of which `is_one` says so.
  Numbers inside(const std::function<bool(int x, int y)>& is_one) const {
    Numbers numbers;
    for (int y = 1; y < side - 1; ++y) {
      for (int x = 1; x < side - 1; ++x) {
        if (is_one(x, y)) {
          numbers.push_back(at(x, y));
        }
      }
    }
    return numbers;
  }
};

TEST_CASE("points inside that carry a marker other than what surrounds them are held and named, with the way out") {
  // An electrode, and a segment from side to side with the marker of the boundary, as Triangle writes them.
  const auto is_segment = [](int, int y) { return y == 5; };
  const Marker markers = [&](int x, int y) { return x == 2 && y == 2 ? 7 : is_segment(x, y) ? 1 : 0; };
  for (const std::string array : {"triangle:marker", "medit:ref", "freefem:label", "Vertex_Markers"}) {
    CAPTURE(array);
    const Grid grid(9, array, markers);
    CHECK(grid.numbers_held() == grid.inside([&](int x, int y) { return (x == 2 && y == 2) || is_segment(x, y); }));
    const HeldSets held = grid.held();
    REQUIRE(held.sets.size() == 1);
    CHECK(held.sets[0].name == array);
    CHECK(held.sets[0].vertices == 8);
    CHECK(held.sets[0].holds);
    CHECK(held.notes == std::vector<std::string>{"8 vertices inside, which '" + array +
                                                 "' marks otherwise than what surrounds them: held fixed; "
                                                 "--fixed-set none frees them"});
    CHECK(grid.held({"none"}).flags.empty());
    CHECK(grid.held({"none"}).notes.empty());
    CHECK(grid.held({array}).flags == held.flags);
  }
  CHECK(says(Grid(9, "medit:ref", [](int x, int y) { return x == 2 && y == 2 ? 7 : 0; }).held().notes.at(0),
             "1 vertex inside, which 'medit:ref' marks otherwise than what surrounds it"));
  // A name that is none of markers, and markers that say nothing.
  CHECK(Grid(9, "temperature_class", markers).held().flags.empty());
  for (const std::int32_t marker : {0, 1, 4}) {
    const HeldSets nothing = Grid(9, "triangle:marker", [marker](int, int) { return marker; }).held();
    CHECK(nothing.sets.empty());
    CHECK(nothing.notes.empty());
  }
}

TEST_CASE("segments through a coarse mesh are held, also where they have more than a third of the points inside") {
  const auto is_cross = [](int x, int y) { return x == 3 || y == 3; };
  const Grid row(5, "triangle:marker", [](int, int y) { return y == 2 ? 3 : 0; });
  CHECK(row.numbers_held() == row.inside([](int, int y) { return y == 2; }));
  const Grid cross(7, "triangle:marker", [&](int x, int y) { return is_cross(x, y) ? 3 : 0; });
  CHECK(cross.numbers_held() == cross.inside(is_cross));
}

TEST_CASE("each region has a marker of its own for what is inside, and so has each surface in a region") {
  // As Gmsh writes it: the numbers of surfaces, and of curves in them and between them.
  constexpr int border = 9;
  const auto is_curve = [](int x, int y) { return x == border || (y == 6 && x > 2 && x < 7) || (x == 11 && y == 3); };
  const Marker markers = [&](int x, int y) {
    return x == border ? 30 : is_curve(x, y) ? 40 + x : x < border ? 10 : 11;
  };
  Grid grid(15, "medit:ref", markers);
  // The triangles are of one group. What is between the surfaces is held by its markers.
  CHECK(grid.numbers_held() == grid.inside(is_curve));
  const HeldSets held = grid.held();
  REQUIRE(held.notes.size() == 2);
  CHECK(says(held.notes[1], "have values of 'medit:ref' that are no marks, being too many or of whole areas"));
  // They are of a group each, between which vertices are held anyway.
  grid.divide(border);
  CHECK(grid.numbers_held() == grid.inside([&](int x, int y) { return x != border && is_curve(x, y); }));
  CHECK(grid.held().notes.size() == 1);
}

TEST_CASE(
    "markers that number points or count them off mark nothing, which a note says with the way to hold vertices") {
  const std::vector<Marker> markers{[](int x, int y) { return 100 * x + y; }, [](int x, int y) { return (x + y) % 2; },
                                    [](int x, int) { return x % 3; }, [](int x, int y) { return (x + y) % 3; }};
  for (std::size_t i = 0; i < markers.size(); ++i) {
    CAPTURE(i);
    Grid grid(11, "medit:ref", markers[i]);
    CHECK(grid.held().flags.empty());
    CHECK(grid.held().sets.empty());
    REQUIRE(grid.held().notes.size() == 1);
    CHECK(says(grid.held().notes[0], "no marks"));
    CHECK(says(grid.held().notes[0], "; a file of --fixed-ids holds vertices"));
    grid.document.first_point_label = 1;
    CHECK(says(grid.held().notes[0], "; a file of --fixed-ids or --fixed-labels holds vertices"));
  }
}

TEST_CASE("zones of points have no marks but those that are in them") {
  const auto is_zone = [](int x, int y) { return x < 9 && y < 9; };
  const Grid grid(21, "medit:ref", [&](int x, int y) { return x == 3 && y == 3 ? 9 : is_zone(x, y) ? 3 : 4; });
  CHECK(grid.numbers_held() == Numbers{grid.at(3, 3)});
  // One vertex and those around it are an electrode.
  const auto is_patch = [](int x, int y) { return std::abs(x - 6) < 2 && std::abs(y - 6) < 2; };
  const Grid patch(21, "medit:ref", [&](int x, int y) { return is_patch(x, y) ? 3 : 4; });
  CHECK(patch.numbers_held() == patch.inside(is_patch));
}

TEST_CASE("what line cells hold anyway is not counted as marked") {
  Grid grid(9, "medit:ref", [](int x, int y) { return y == 4 ? 5 : x == 3 && y == 2 ? 6 : 2; });
  for (int x = 1; x < 8; ++x) {
    grid.document.cells.append(trismooth::cell_type::line, Numbers{grid.at(x, 4), grid.at(x + 1, 4)});
  }
  CHECK(grid.numbers_held() == Numbers{grid.at(3, 2)});
}

}  // namespace trismooth::marked_points_test
