// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/svg_picture.h"

#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "catch.h"
#include "picture/sample_picture.h"
#include "support/parsed_page.h"

namespace trismooth::svg_picture_test {

using Points = std::vector<Point2<double>>;

/// The polygons of a path, read as the SVG specification says: M, m, l, z and numbers.
std::vector<Points> polygons(const std::string& path) {
  std::vector<Points> found;
  Point2<double> now{0, 0};
  char command = ' ';
  std::size_t at = 0;
  const auto number = [&] {
    std::size_t used = 0;
    const double value = std::stod(path.substr(at), &used);
    at += used;
    return value;
  };
  while (at < path.size()) {
    if (std::isspace(static_cast<unsigned char>(path[at])) != 0) {
      ++at;
      continue;
    }
    if (std::isalpha(static_cast<unsigned char>(path[at])) != 0) {
      command = path[at++];
      if (command == 'z') {
        now = found.back().front();
      }
      continue;
    }
    const double x = number();
    const double y = number();
    const bool is_absolute = command == 'M' || command == 'L';
    now = is_absolute ? Point2<double>{x, y} : Point2<double>{now.x + x, now.y + y};
    if (command == 'M' || command == 'm') {
      found.emplace_back();
      command = command == 'M' ? 'L' : 'l';
    }
    found.back().push_back(now);
  }
  return found;
}

SvgPicture draw(const MeshPicture& picture, const SheetOptions& options = {}, const char* value = "shape",
                std::size_t most = most_elements_of_svg) {
  const ElementShades shades(picture, picture_value_named(value), 1);
  return svg_picture(shades, mesh_lines(picture), picture_sheet(shades, options), 1, most);
}

pages::Parsed parsed(const SvgPicture& svg) {
  pages::Parsed page = pages::parse(svg.text);
  INFO(page.error);
  REQUIRE(page.error.empty());
  return page;
}

/// The paths of one element each or more, but not lines.
std::vector<pages::Element> fills(const pages::Parsed& page) {
  std::vector<pages::Element> found = page.all("path");
  std::erase_if(found, [](const pages::Element& path) { return path.attribute("fill") == "none"; });
  return found;
}

TEST_CASE("elements of one colour are one path, whose polygons are where they are") {
  const MeshPicture picture = samples::square();
  SheetOptions options;
  options.window = Box{{0, 0}, {2, 2}};
  const pages::Parsed page = parsed(draw(picture, options));
  const auto paths = fills(page);
  REQUIRE(paths.size() == 1);
  CHECK(paths[0].attribute("fill") == css_colour(colour_at(quality_colours, 0.87)));
  const auto elements = polygons(paths[0].attribute("d"));
  const pages::Element panel = page.all("svg").at(1);
  const double scale = panel.number("width") * 10 / 2;  // units for one of the mesh
  CHECK(panel.attribute("viewBox") == "0 0 9000 9000");
  REQUIRE(elements.size() == 4);
  for (std::size_t e = 0; e < 4; ++e) {
    const auto corners = picture.elements.list()[e];
    REQUIRE(elements[e].size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2<double> place = picture.before[static_cast<std::size_t>(corners[i])];
      CHECK(elements[e][i].x == place.x * scale);
      CHECK(elements[e][i].y == (2 - place.y) * scale);
    }
  }
}

TEST_CASE("boundary and interfaces are one path of lines") {
  const pages::Parsed page = parsed(draw(samples::mixed()));
  std::vector<pages::Element> lines = page.all("path");
  std::erase_if(lines, [](const pages::Element& path) { return path.attribute("fill") != "none"; });
  REQUIRE(lines.size() == 1);
  CHECK(polygons(lines[0].attribute("d")).size() == 6);
}

TEST_CASE("the worst elements are above all others") {
  MeshPicture picture = samples::square();
  picture.before[4] = {3, 1};
  const auto paths = fills(parsed(draw(picture)));
  CHECK(paths.back().attribute("fill") == css_colour(inverted_colour));
}

TEST_CASE("what is out of the window is left out, and what is far from it is cut off") {
  const MeshPicture picture = samples::square();
  SheetOptions options;
  options.window = Box{{0.9, 0.1}, {1.1, 0.3}};
  const auto below = fills(parsed(draw(picture, options)));
  REQUIRE(below.size() == 1);
  CHECK(polygons(below[0].attribute("d")).size() == 1);
  options.window = Box{{1 - 1e-9, 0.5}, {1 + 1e-9, 0.5 + 2e-9}};  // inside of one element
  const auto inside = polygons(fills(parsed(draw(picture, options))).at(0).attribute("d"));
  REQUIRE(inside.size() == 1);
  for (const Point2<double> point : inside[0]) {
    CHECK(std::abs(point.x) <= 20'000);
    CHECK(std::abs(point.y) <= 20'000);
  }
  options.window = Box{{5, 5}, {6, 6}};
  CHECK(fills(parsed(draw(picture, options))).empty());
}

TEST_CASE("names of regions stay text, whatever they hold") {
  MeshPicture picture = samples::mixed();
  picture.region_names = {"<b>\"'&", "\x01\xff\n"};
  const pages::Parsed page = parsed(draw(picture, {}, "region"));
  CHECK(page.count("b") == 0);
  CHECK(page.says("<b>\"'&"));
  picture.region_names = {"a name that is rather long", "iron"};
  CHECK(parsed(draw(picture, {}, "region")).says("a name..."));
}

TEST_CASE("the legend names the metric and its scale, of both kinds where they differ") {
  const pages::Parsed of_angles = parsed(draw(samples::mixed(), {}, "min_angle"));
  for (const char* const words : {"min_angle, degrees", "60 / 90", "30 / 45", "inverted"}) {
    CAPTURE(words);
    CHECK(of_angles.says(words));
  }
  CHECK(of_angles.count("linearGradient") == 1);
  CHECK(parsed(draw(samples::mixed(), {}, "skew")).says("triangles have none"));
  CHECK(parsed(draw(samples::square(), {}, "aspect_ratio")).says("inf"));
  const pages::Parsed of_regions = parsed(draw(samples::mixed(), {}, "region"));
  CHECK(of_regions.says("iron"));
  CHECK(of_regions.count("linearGradient") == 0);
}

TEST_CASE("those who do not see it are told what it shows") {
  const SheetOptions options{std::nullopt, 2};
  const pages::Parsed page = parsed(draw(samples::square(), options));
  CHECK(page.elements.front().attribute("role") == "img");
  CHECK(page.elements.at(1).name == "title");
  CHECK(page.all("title").at(0).text.find("4 elements") != std::string::npos);
  CHECK(page.all("desc").at(0).text.find("1: element 0, shape 0.866") != std::string::npos);
}

TEST_CASE("close-ups are of the worst elements in the window, the worst first, by their numbers in the file") {
  MeshPicture picture = samples::square();
  picture.before[4] = {1, 0.25};
  picture.numbers.assign({10, 20, 30, 40});
  SheetOptions options{std::nullopt, 2};
  const pages::Parsed page = parsed(draw(picture, options));
  CHECK(page.count("svg") == 4);
  CHECK(page.says("1: element 10"));
  CHECK(page.says("2: element 20"));
  CHECK(page.count("circle") == 8);  // two for a mark, which the main picture and the close-up have
  options.window = Box{{0.5, 1.5}, {1.5, 2}};
  const pages::Parsed above = parsed(draw(picture, options));
  CHECK(above.says("1: element 30"));
  CHECK_FALSE(above.says("element 10"));
  options.worst = 20;
  CHECK(parsed(draw(picture, options)).count("svg") == 3);  // no other is there
  CHECK(parsed(draw(samples::mixed(), {std::nullopt, 1}, "region")).says("1: element 1"));
}

TEST_CASE("many elements are an image, which is said") {
  const SvgPicture svg = draw(samples::square(), {}, "shape", 3);
  CHECK(svg.elements_as_pixels == 4);
  const pages::Parsed page = parsed(svg);
  CHECK(page.count("image") == 1);
  CHECK(page.all("image")[0].attribute("xlink:href").starts_with("data:image/png;base64,iVBORw0KGgo"));
  CHECK(fills(page).empty());
  CHECK(page.count("path") == 1);
  CHECK(draw(samples::square(), {}, "shape", 4).elements_as_pixels == 0);
}

TEST_CASE("the same mesh gives the same bytes") {
  const SheetOptions options{std::nullopt, 3};
  CHECK(draw(samples::mixed(), options).text == draw(samples::mixed(), options).text);
}

TEST_CASE("a mesh without elements is a picture as well") {
  CHECK(fills(parsed(draw({}))).empty());
  CHECK(fills(parsed(draw({}, {}, "area"))).empty());
}

}  // namespace trismooth::svg_picture_test
