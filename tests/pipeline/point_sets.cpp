// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/point_sets.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.h"
#include "support/says.h"
#include "support/scratch_folder.h"

namespace trismooth::point_sets_test {

using Numbers = std::vector<std::int32_t>;
using Bytes = std::vector<std::uint8_t>;

/// A grid of `side` x `side` points, two triangles a cell; row by row.
std::vector<Triangle> grid_triangles(std::int32_t side) {
  std::vector<Triangle> triangles;
  for (std::int32_t y = 0; y + 1 < side; ++y) {
    for (std::int32_t x = 0; x + 1 < side; ++x) {
      const std::int32_t a = y * side + x;
      triangles.push_back({a, a + 1, a + side + 1});
      triangles.push_back({a, a + side + 1, a + side});
    }
  }
  return triangles;
}

MeshDocument with_sets(std::int32_t side, std::vector<NamedSet> sets) {
  MeshDocument document;
  document.points.assign(3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
  document.point_sets = std::move(sets);
  return document;
}

Numbers all_of(std::int32_t count) {
  Numbers numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST_CASE("sets of points hold their vertices; one of a whole part holds nothing and is named") {
  const auto triangles = grid_triangles(4);
  const MeshDocument document = with_sets(4, {{"Corners", {3, 0, 15, 12, 0}}, {"NALL", all_of(16)}, {"EMPTY", {}}});
  const HeldSets held = find_held_sets(document, triangles);
  REQUIRE(held.sets.size() == 3);
  CHECK(held.sets[0].name == "Corners");
  CHECK(held.sets[0].vertices == 4);
  CHECK(held.sets[0].holds);
  CHECK_FALSE(held.sets[0].is_area);
  CHECK(held.sets[1].vertices == 16);
  CHECK(held.sets[1].is_area);
  CHECK_FALSE(held.sets[1].holds);
  CHECK(held.sets[2].vertices == 0);
  CHECK_FALSE(held.sets[2].holds);
  CHECK(held.flags == Bytes{1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1});
  REQUIRE(held.notes.size() == 2);
  CHECK(says(held.notes[0], "'NALL'; --fixed-set NALL holds"));
  CHECK(held.notes[1] == "point sets without points hold nothing: 'EMPTY'");
}

TEST_CASE("implied sets hold what is inside the mesh and of no line, also where this covers an area") {
  const auto triangles = grid_triangles(5);
  MeshDocument document = with_sets(5, {{"Corners", {0}}});
  document.implied_sets = {{"curves", {0, 1, 2, 3, 4, 11, 12, 13}}, {"points", {5}}, {"all", all_of(25)}};
  document.cells.append(trismooth::cell_type::line, std::vector<std::int32_t>{12, 13});
  const HeldSets held = find_held_sets(document, triangles);
  REQUIRE(held.sets.size() == 3);
  CHECK(held.sets[1].name == "curves");
  CHECK(held.sets[1].vertices == 1);
  CHECK(held.sets[1].holds);
  CHECK(held.sets[2].name == "all");
  CHECK(held.sets[2].vertices == 7);
  CHECK(held.sets[2].holds);
  CHECK(held.notes.empty());
  const std::vector<std::string> none{"none"};
  CHECK(find_held_sets(document, triangles, none).flags.empty());
  const std::vector<std::string> named{"curves"};
  const HeldSets curves = find_held_sets(document, triangles, named);
  const Bytes& flags = curves.flags;
  CHECK(curves.notes ==
        std::vector<std::string>{
            "6 points of 'all' may move, since other sets are named; --fixed-set all beside these holds them"});
  CHECK(find_held_sets(document, triangles, none).notes.empty());
  CHECK(std::accumulate(flags.begin(), flags.end(), 0) == 1);
  CHECK(flags[11] == 1);
  // What lies between two regions is held by these: here rows of cells above and below the points 5 to 9.
  std::vector<std::int32_t> regions(triangles.size(), 1);
  std::fill_n(regions.begin(), 8, 0);
  CHECK(find_held_sets(document, triangles, {}, regions).sets[2].vertices == 4);
  // Without a set of the file's own, and without one that is left.
  document.point_sets.clear();
  CHECK(find_held_sets(document, triangles).sets.size() == 2);
  document.implied_sets = {{"points", {5}}};
  CHECK(find_held_sets(document, triangles).sets.empty());
}

TEST_CASE("an area is what has all neighbours of a vertex inside the mesh") {
  const auto triangles = grid_triangles(5);
  const auto is_area = [&](const Numbers& members) {
    return find_held_sets(with_sets(5, {{"set", members}}), triangles).sets[0].is_area;
  };
  CHECK(is_area({6, 5, 7, 1, 11, 0, 12}));               // a vertex and its six neighbours
  CHECK_FALSE(is_area({6, 5, 7, 1, 11, 0}));             // one neighbour is missing
  CHECK_FALSE(is_area({0, 1, 2, 3, 4, 5, 6}));           // two rows of the boundary
  CHECK_FALSE(is_area({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));  // the strip along it: all its vertices inside have others
  CHECK(is_area({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}));
  CHECK_FALSE(is_area({6, 7, 8, 11, 13, 16, 17, 18}));  // a closed line
}

TEST_CASE("a vertex on the boundary, or with triangles twice, is not inside") {
  const MeshDocument document = with_sets(3, {{"fan", {0, 1, 2, 3}}});
  CHECK(find_held_sets(document, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}).sets[0].is_area);
  CHECK_FALSE(find_held_sets(document, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}).sets[0].is_area);
  CHECK_FALSE(find_held_sets(document, std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}, {0, 1, 2}}).sets[0].is_area);
}

TEST_CASE("sets that are named are taken, areas too, and no other") {
  const auto triangles = grid_triangles(4);
  const MeshDocument document = with_sets(4, {{"Corners", {0}}, {"N ALL", all_of(16)}, {"left", {4}}});
  const auto held = [&](std::vector<std::string> names) { return find_held_sets(document, triangles, names); };
  CHECK(std::ranges::count(held({"n_all"}).flags, 1) == 16);
  CHECK(held({"n_all"}).notes.empty());
  CHECK(std::ranges::count(held({"left", "Corners"}).flags, 1) == 2);
  CHECK(held({"none"}).flags.empty());
  CHECK(held({"none"}).sets.size() == 3);
  CHECK_FALSE(held({"none"}).sets[0].holds);
  CHECK(message_of<std::invalid_argument>([&] { held({"right"}); }) ==
        "the file has no point set 'right' to hold; it has: Corners, N ALL, left");
  CHECK_THROWS_AS(held({"none", "left"}), std::invalid_argument);
  CHECK(says(message_of<std::invalid_argument>(
                 [&] { find_held_sets(with_sets(4, {}), triangles, std::vector<std::string>{"left"}); }),
             "it has: none"));
  CHECK(find_held_sets(with_sets(4, {}), triangles, std::vector<std::string>{"none"}).sets.empty());
}

TEST_CASE("many sets of one large fan are judged in the time of their members") {
  constexpr std::int32_t rim = 60'000;
  std::vector<Triangle> triangles;
  for (std::int32_t v = 1; v <= rim; ++v) {
    triangles.push_back({0, v, v == rim ? 1 : v + 1});
  }
  std::vector<NamedSet> sets;
  for (std::int32_t s = 0; s < 60'000; ++s) {
    sets.push_back({"s" + std::to_string(s), {0, 1, 2, s}});
  }
  sets.push_back({"all", all_of(rim + 1)});
  MeshDocument document = with_sets(1, std::move(sets));
  document.points.assign(3 * (rim + 1), 0.0);
  const HeldSets held = find_held_sets(document, triangles);
  CHECK(std::ranges::count_if(held.sets, [](const auto& set) { return set.is_area; }) == 1);
  CHECK(held.sets.back().is_area);
}

TEST_CASE("cell sets are counted") {
  MeshDocument document;
  document.cell_sets = {{"EALL", {2, 1, 0, 1}}, {"none", {}}};
  const auto sets = trismooth::summarise_cell_sets(document);
  REQUIRE(sets.size() == 2);
  CHECK(sets[0].name == "EALL");
  CHECK(sets[0].cells == 3);
  CHECK(sets[1].cells == 0);
}

TEST_CASE("a label holds points, points of lines and of triangles; a set of that very name comes first") {
  const auto triangles = grid_triangles(4);
  MeshDocument document = with_sets(4, {{"ref=3", {15}}});
  document.cells.append(trismooth::cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(trismooth::cell_type::triangle, std::vector<std::int32_t>{5, 6, 10});
  document.cells.append(trismooth::cell_type::triangle, std::vector<std::int32_t>{5, 10, 9});
  constexpr std::int64_t beyond_doubles = (std::int64_t{1} << 53) + 1;
  document.cell_arrays.push_back(trismooth::make_data_array("ref", 1, std::vector<std::int64_t>{2, 2, beyond_doubles}));
  document.point_arrays.push_back(
      trismooth::make_data_array("Ref", 1, std::vector<float>{0, 0, 0, 0.1F, 0, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0}));
  document.point_arrays.push_back(trismooth::make_data_array("velocity", 2, std::vector<float>(32, 2)));
  document.point_arrays.push_back(trismooth::make_data_array("trismooth:fixed", 1, std::vector<float>(16, 2)));
  const auto held = [&](const std::string& name) {
    const Bytes flags = find_held_sets(document, triangles, std::vector<std::string>{name}).flags;
    Numbers points;
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (flags[v] != 0) {
        points.push_back(static_cast<std::int32_t>(v));
      }
    }
    return points;
  };
  CHECK(held("ref=3") == Numbers{15});
  CHECK(held("ref=2") == Numbers{0, 1, 5, 6, 10});
  CHECK(held("ref=2.0") == Numbers{0, 1, 5, 6, 10});
  CHECK(held("ref=9007199254740993") == Numbers{5, 9, 10});
  CHECK_THROWS_AS(held("ref=9007199254740992"), std::invalid_argument);
  CHECK(held("Ref=0.1") == Numbers{3});
  CHECK(held("Ref=7") == Numbers{12});
  for (const char* const name : {"velocity=2", "trismooth:fixed=2", "=2", "ref=", "ref"}) {
    CHECK_THROWS_AS(held(name), std::invalid_argument);
  }
}

TEST_CASE("a name that one array alone has for a value holds without the array, and names are listed and suggested") {
  const auto triangles = grid_triangles(4);
  MeshDocument document = with_sets(4, {{"Corners", {15}}});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{5, 6, 10});
  ArrayDescription names;
  names.value_names = {{1, 1, "clamped"}, {7, 2, "inclusion"}};
  document.cell_arrays.push_back(make_data_array("med:group", 1, std::vector<std::int32_t>{1, 7}));
  document.cell_arrays[0].description = std::make_shared<const ArrayDescription>(names);
  const auto held = [&](const std::string& name) {
    return find_held_sets(document, triangles, std::vector<std::string>{name});
  };
  const auto refusal = [&](const std::string& name) { return message_of<std::invalid_argument>([&] { held(name); }); };
  CHECK(held("clamped").flags == held("med:group=clamped").flags);
  CHECK(std::ranges::count(held("clamped").flags, 1) == 2);
  CHECK(std::ranges::count(held("inclusion").flags, 1) == 3);
  CHECK(held("clamped").sets.back().name == "med:group=clamped");
  CHECK(refusal("claped") ==
        "the file has no point set 'claped' to hold (did you mean 'clamped'?); it has: Corners, clamped, inclusion; "
        "points are named as ARRAY=NUMBER, or ARRAY=NAME, by its arrays: med:group");
  // A number is no name.
  CHECK(refusal("7") == "the file has no point set '7' to hold; did you mean 'med:group=7'?");
  // Nor does a name hold that two arrays have, nor one that a set has.
  document.cell_arrays.push_back(document.cell_arrays[0]);
  document.cell_arrays[1].name = "other";
  CHECK(refusal("clamped") ==
        "the file has no point set 'clamped' to hold; did you mean 'med:group=clamped' or 'other=clamped'?");
  document.point_sets[0].name = "Clamped";
  CHECK(held("clamped").sets[0].holds);
}

}  // namespace trismooth::point_sets_test
