// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/still_picture.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <set>

#include "catch.h"
#include "picture/sample_picture.h"

namespace trismooth::still_picture_test {

constexpr Colour white{255, 255, 255};

Colour at(const StillPicture& picture, int x, int y) {
  const std::size_t place =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  return {picture.rgb[place], picture.rgb[place + 1], picture.rgb[place + 2]};
}

/// The square of samples::square() on 100 by 100 pixels.
StillOptions of_square() {
  StillOptions options;
  options.width = 100;
  options.height = 100;
  options.window = Box{{0, 0}, {2, 2}};
  options.lines = false;
  return options;
}

TEST_CASE("each of four triangles has the pixels that are inside, in its colour") {
  MeshPicture picture = samples::square();
  picture.regions = {0, 1, 2, 3};
  picture.region_names = {"below", "right", "above", "left"};
  StillOptions options = of_square();
  options.value.kind = ShownKind::region;
  const StillPicture still = draw_still(picture, options);
  REQUIRE(still.rgb.size() == 30'000);
  int wrong = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const double right = x + 0.5 - 50;
      const double down = y + 0.5 - 50;
      if (std::abs(std::abs(right) - std::abs(down)) > 0.1) {
        const std::size_t element = std::abs(down) > std::abs(right) ? (down > 0 ? 0U : 2U) : (right > 0 ? 1U : 3U);
        wrong += at(still, x, y) == region_colours[element] ? 0 : 1;
      }
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("a window is as large as it fits, in the middle, and the rest is white") {
  StillOptions options = of_square();
  options.width = 200;
  const StillPicture still = draw_still(samples::square(), options);
  CHECK(at(still, 45, 50) == white);
  CHECK(at(still, 55, 50) != white);
  CHECK(at(still, 145, 50) != white);
  CHECK(at(still, 155, 50) == white);
  options.window = Box{{10, 10}, {12, 12}};
  for (const std::uint8_t byte : draw_still(samples::square(), options).rgb) {
    REQUIRE(byte == 255);
  }
}

TEST_CASE("without a window all of the mesh is there, with some room around it") {
  StillOptions options = of_square();
  options.window.reset();
  const StillPicture still = draw_still(samples::square(), options);
  CHECK(at(still, 0, 50) == white);
  CHECK(at(still, 50, 0) == white);
  CHECK(at(still, 3, 50) != white);
  CHECK(at(still, 96, 50) != white);
}

TEST_CASE("meshes of any size are drawn as those of size 1") {
  StillOptions options = of_square();
  options.window.reset();
  const StillPicture expected = draw_still(samples::square(), options);
  for (const int exponent : {-1000, -600, 600, 1021}) {
    MeshPicture picture = samples::square();
    for (Point2<double>& point : picture.before) {
      // Around 0, so that the largest is wider than any number.
      point = {std::ldexp(point.x - 1, exponent + 2), std::ldexp(point.y - 1, exponent + 2)};
    }
    const bool is_same = draw_still(picture, options).rgb == expected.rgb;
    CAPTURE(exponent);
    CHECK(is_same);
  }
}

TEST_CASE("an element that is smaller than a pixel, or thinner, is seen, and the worst one wins") {
  MeshPicture picture = samples::square();
  // Above the others: a tiny inverted one, and one as long as the square and a thousandth of a pixel high.
  for (const Point2<double> point :
       {Point2<double>{0.5, 1.0}, {0.501, 1.001}, {0.501, 1.0}, {0.0, 0.31}, {2.0, 0.31}, {2.0, 0.31002}}) {
    picture.before.push_back(point);
  }
  picture.elements.append(Triangle{5, 6, 7});
  picture.elements.append(Triangle{8, 9, 10});
  const StillPicture still = draw_still(picture, of_square());
  CHECK(at(still, 25, 49) == inverted_colour);
  CHECK(at(still, 25, 53) != inverted_colour);
  for (int x = 0; x < 100; ++x) {
    CHECK(at(still, x, 84) == quality_colours.front().colour);
    CHECK(at(still, x, 86) != quality_colours.front().colour);
  }
}

TEST_CASE("edges are drawn of elements that are large enough, boundaries always") {
  StillOptions options = of_square();
  options.lines = true;
  options.window = Box{{-1, -1}, {3, 3}};
  const StillPicture large = draw_still(samples::square(), options);
  const Colour inside = at(large, 50, 60);
  CHECK(at(large, 60, 60) != inside);  // on a diagonal
  CHECK(at(large, 25, 50).red < 100);  // on the left side
  CHECK(at(large, 10, 50) == white);
  options.window = Box{{-50, -50}, {52, 52}};  // 2 pixels wide: no edges, but its boundary
  const StillPicture small = draw_still(samples::square(), options);
  CHECK(at(small, 49, 49).red < 100);
  CHECK(at(small, 52, 50) == white);
  options.window = Box{{-16, -16}, {18, 18}};  // edges of 4 to 6 pixels
  options.lines = false;
  const StillPicture plain = draw_still(samples::square(), options);
  options.lines = true;
  const StillPicture lined = draw_still(samples::square(), options);
  CHECK(at(plain, 50, 50) == at(lined, 50, 50));
}

TEST_CASE("the mesh as it was and as it is") {
  MeshPicture picture = samples::square();
  picture.after = picture.before;
  picture.after[4] = {3, 1};  // inverts the triangle on the right
  StillOptions options = of_square();
  options.window = Box{{0, 0}, {3, 3}};
  CHECK(at(draw_still(picture, options), 77, 67) == inverted_colour);
  options.before = true;
  CHECK(at(draw_still(picture, options), 77, 67) == white);
}

TEST_CASE("quadrilaterals are filled, also where a corner points inwards") {
  MeshPicture picture = samples::mixed();
  picture.before[2] = {0.25, 0.25};
  StillOptions options = of_square();
  options.window = Box{{0, 0}, {1, 1}};
  const StillPicture still = draw_still(picture, options);
  CHECK(at(still, 10, 50) == inverted_colour);  // of the quadrilateral's arm
  CHECK(at(still, 60, 30) == white);            // outside, where the corner was
}

TEST_CASE("the picture does not depend on the threads") {
  MeshPicture picture;
  constexpr int side = 200;
  std::vector<Triangle> triangles;
  std::mt19937 random(3);
  for (int i = 0; i < side * side; ++i) {
    const auto place = [&random] { return static_cast<double>(random() % 1000) / 10; };
    picture.before.push_back({place(), place()});
    if (i % 2 == 0 && i + 2 < side * side) {
      triangles.push_back({i, i + 1, i + 2});
    }
  }
  for (Triangle& triangle : triangles) {
    triangle[2] = (triangle[0] * 7) % (side * side);
  }
  picture.elements = triangles;
  StillOptions options = of_square();
  options.window.reset();
  options.lines = true;
  const StillPicture one = draw_still(picture, options);
  options.threads = 4;
  CHECK(draw_still(picture, options).rgb == one.rgb);
}

TEST_CASE("a mesh without elements, and one without extent, are pictures as well") {
  CHECK(draw_still({}, of_square()).rgb.size() == 30'000);
  MeshPicture point = samples::square();
  for (auto& place : point.before) {
    place = {5, 5};
  }
  StillOptions options = of_square();
  options.window.reset();
  CHECK(draw_still(point, options).rgb.size() == 30'000);
}

}  // namespace trismooth::still_picture_test
