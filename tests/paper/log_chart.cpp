// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/log_chart.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.h"
#include "support/parsed_page.h"

using pages::Element;
using trismooth::Spread;
using trismooth::experiments::Arrangement;
using trismooth::experiments::ChartPanel;
using trismooth::experiments::ChartPoint;
using trismooth::experiments::ChartSeries;
using trismooth::experiments::LineStyle;
using trismooth::experiments::log_chart_svg;
using trismooth::experiments::LogChart;
using trismooth::experiments::Marker;

namespace {

/// The numbers of a path, of a list of points or of a transformation.
std::vector<double> numbers(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return std::string("0123456789.-").find(c) == std::string::npos; }, ' ');
  std::istringstream stream(text);
  std::vector<double> values;
  for (double value = 0; stream >> value;) {
    values.push_back(value);
  }
  return values;
}

struct Place {
  double x = 0;
  double y = 0;
};

struct Picture : pages::Parsed {
  /// The markers of points: those with a tooltip.
  std::vector<Element> markers() const {
    std::vector<Element> found = all("path");
    std::erase_if(found, [](const Element& e) { return e.text.empty(); });
    return found;
  }
  /// Of the markers, in the order of the picture.
  std::vector<Place> places() const {
    std::vector<Place> found;
    for (const Element& marker : markers()) {
      const std::vector<double> values = numbers(marker.attribute("transform"));
      found.push_back({values.at(0), values.at(1)});
    }
    return found;
  }
  std::vector<Element> whiskers() const {
    std::vector<Element> found = all("path");
    std::erase_if(found, [](const Element& e) { return e.attributes.contains("transform"); });
    return found;
  }
  std::vector<Element> frames() const {
    std::vector<Element> found = all("rect");
    std::erase_if(found, [](const Element& e) { return e.attribute("fill") != "none"; });
    return found;
  }
  auto texts(const std::string& words) const {
    return std::ranges::count_if(elements, [&](const Element& e) { return e.name == "text" && e.text == words; });
  }
};

ChartPoint exact(double x, double y) {
  return {x, Spread(y, y, y)};
}

ChartSeries series(const std::string& label, const std::vector<ChartPoint>& points, const LineStyle& style = {}) {
  return {label, style, points};
}

LogChart chart(const std::vector<ChartPanel>& panels) {
  return {"times", "what it shows", "vertices", "ms", panels};
}

Picture draw(const LogChart& chart) {
  const std::string svg = log_chart_svg(chart);
  Picture picture{pages::parse(svg)};
  REQUIRE(picture.error.empty());
  for (const Element& element : picture.elements) {
    for (const auto& [key, value] : element.attributes) {
      CAPTURE(element.name, key, value);
      CHECK(value.find("nan") == std::string::npos);
      CHECK(value.find("inf") == std::string::npos);
    }
  }
  return picture;
}

/// Two panels, three lines, sizes of the paper.
LogChart sample_chart() {
  const auto line = [](const std::string& label, double first, const LineStyle& style) {
    ChartSeries drawn = series(label, {}, style);
    for (const double x : {1e3, 5e3, 1e4, 5e4, 1e5}) {
      const double y = first * x / 1e3;
      drawn.points.push_back({x, Spread(y, 0.8 * y, 1.3 * y)});
    }
    return drawn;
  };
  const ChartSeries serial = line("serial", 300, {"#000", Marker::circle, true, false, false});
  const ChartSeries device = line("device", 0.4, {"#06c", Marker::square, false, true, false});
  const ChartSeries paper = line("paper", 20, {"#999", Marker::triangle, true, false, true});
  return chart({{"Form A", {serial, device, paper}}, {"Form B", {device, paper}}});
}

constexpr double rounding = 0.021;  // of differences of places that are written with two decimals

}  // namespace

TEST_CASE("a chart with hostile texts is well-formed and says them literally") {
  const std::string hostile = "<a&b>\"'";
  LogChart drawn = chart({{hostile, {series(hostile, {exact(1, 1), exact(10, 2)})}}});
  drawn.description = drawn.x_title = drawn.y_title = hostile;
  const Picture picture = draw(drawn);
  CHECK(picture.texts(hostile) == 4);
  const Element& root = picture.elements.front();
  CHECK(root.attribute("aria-label") == hostile);
  CHECK(root.attribute("id") == "times");
  CHECK(root.attribute("role") == "img");
  REQUIRE(picture.markers().size() == 2);
  CHECK(picture.markers()[0].text == hostile + ", 1: 1.00 (1.00-1.00)");
}

TEST_CASE("a chart needs nothing from the page that it is in") {
  const Picture picture = draw(sample_chart());
  CHECK(picture.elements.front().attribute("xmlns") == "http://www.w3.org/2000/svg");
  CHECK(picture.elements.front().attribute("font-family").ends_with("sans-serif"));
  REQUIRE(picture.elements.at(1).name == "rect");
  CHECK(picture.elements.at(1).attribute("fill") == "#fff");
  for (const Element& element : picture.elements) {
    CHECK(element.attribute("class").empty());
    CHECK(element.attribute("style").empty());
    CHECK(element.name != "style");
  }
}

TEST_CASE("a series has its line and a marker at every point of it") {
  const Picture picture = draw(sample_chart());
  const std::vector<Element> lines = picture.all("polyline");
  const std::vector<Place> places = picture.places();
  REQUIRE(lines.size() == 5);
  REQUIRE(places.size() == 25);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<double> points = numbers(lines[i].attribute("points"));
    REQUIRE(points.size() == 10);
    for (std::size_t k = 0; k < 5; ++k) {
      CHECK(points[2 * k] == places[5 * i + k].x);
      CHECK(points[2 * k + 1] == places[5 * i + k].y);
    }
  }
}

TEST_CASE("faint lines are thinner and lie below the others, dashes and open markers are drawn") {
  const Picture picture = draw(sample_chart());
  const std::vector<Element> lines = picture.all("polyline");
  const std::vector<Element> markers = picture.markers();
  REQUIRE(lines.size() == 5);
  REQUIRE(markers.size() == 25);
  CHECK(lines[0].attribute("stroke") == "#999");
  CHECK(lines[1].attribute("stroke") == "#000");
  CHECK(lines[0].number("stroke-width") < lines[1].number("stroke-width"));
  CHECK(lines[1].attribute("stroke-dasharray").empty());
  CHECK_FALSE(lines[2].attribute("stroke-dasharray").empty());
  CHECK(markers[5].attribute("fill") == "#000");
  CHECK(markers[10].attribute("fill") == "#fff");
  CHECK(markers[10].attribute("stroke") == "#06c");
}

TEST_CASE("every marker has its shape") {
  std::vector<std::string> shapes;
  for (const Marker marker : {Marker::circle, Marker::square, Marker::diamond, Marker::triangle, Marker::cross}) {
    const Picture picture = draw(chart({{"", {series("a", {exact(1, 1)}, {"#000", marker, true, false, false})}}}));
    REQUIRE(picture.markers().size() == 1);
    shapes.push_back(picture.markers()[0].attribute("d"));
  }
  std::ranges::sort(shapes);
  CHECK(std::ranges::adjacent_find(shapes) == shapes.end());
}

TEST_CASE("equal ratios are equal distances, and more is higher and farther right") {
  const std::vector<Place> places =
      draw(chart({{"", {series("a", {exact(1, 0.5), exact(10, 5), exact(100, 50)})}}})).places();
  REQUIRE(places.size() == 3);
  CHECK(places[1].x > places[0].x + 10);
  CHECK(places[1].y < places[0].y - 10);
  CHECK(places[2].x - places[1].x == Approx(places[1].x - places[0].x).margin(rounding));
  CHECK(places[2].y - places[1].y == Approx(places[1].y - places[0].y).margin(rounding));
}

TEST_CASE("the panels share both axes") {
  const Picture picture = draw(chart({{"left", {series("a", {exact(1, 1), exact(10, 7)})}},
                                      {"right", {series("b", {exact(10, 7), exact(1000, 900)})}}}));
  const std::vector<Place> places = picture.places();
  const std::vector<Element> frames = picture.frames();
  REQUIRE(places.size() == 4);
  REQUIRE(frames.size() == 2);
  CHECK(places[1].y == places[2].y);
  CHECK(places[1].x - frames[0].number("x") == Approx(places[2].x - frames[1].number("x")).margin(rounding));
  CHECK(frames[0].number("width") == frames[1].number("width"));
  CHECK(frames[0].number("x") + frames[0].number("width") < frames[1].number("x"));
}

TEST_CASE("all points and whiskers lie inside their panel, and all panels inside the picture") {
  const Picture picture = draw(sample_chart());
  const std::vector<Element> frames = picture.frames();
  REQUIRE(frames.size() == 2);
  const auto inside = [](const Element& frame, const Place& place, double space) {
    const double x = place.x - frame.number("x");
    const double y = place.y - frame.number("y");
    return x > space && y > space && x < frame.number("width") - space && y < frame.number("height") - space;
  };
  const std::vector<Place> places = picture.places();
  REQUIRE(places.size() == 25);
  for (std::size_t i = 0; i < places.size(); ++i) {
    CAPTURE(i);
    constexpr double marker = 5;
    CHECK(inside(frames[i < 15 ? 0 : 1], places[i], marker));
  }
  const std::vector<Element> whiskers = picture.whiskers();
  REQUIRE(whiskers.size() == 25);
  for (std::size_t i = 0; i < whiskers.size(); ++i) {
    const std::vector<double> values = numbers(whiskers[i].attribute("d"));
    CHECK(inside(frames[i < 15 ? 0 : 1], {values.at(3), values.at(4)}, 1));
    CHECK(inside(frames[i < 15 ? 0 : 1], {values.at(3), values.at(5)}, 1));
  }
  const std::vector<double> box = numbers(picture.elements.front().attribute("viewBox"));
  REQUIRE(box.size() == 4);
  CHECK(frames[0].number("x") > 0);
  CHECK(frames[1].number("x") + frames[1].number("width") < box[2]);
}

TEST_CASE("in a column every panel has both axes, below the one before and above the legend, in a narrow picture") {
  LogChart drawn = sample_chart();
  const Picture row = draw(drawn);
  drawn.arrangement = Arrangement::column;
  const Picture column = draw(drawn);
  const std::vector<double> box = numbers(column.elements.front().attribute("viewBox"));
  REQUIRE(box.size() == 4);
  CHECK(box[2] < numbers(row.elements.front().attribute("viewBox")).at(2) / 2);
  const std::vector<Element> panels = column.all("g");
  const std::vector<Element> frames = column.frames();
  REQUIRE(panels.size() == 2);
  REQUIRE(frames.size() == 2);
  std::vector<double> tops;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<double> moved = numbers(panels[i].attribute("transform"));
    REQUIRE(moved.size() == 2);
    CHECK(moved[0] == 0);
    tops.push_back(moved[1] + frames[i].number("y"));
    CHECK(frames[i].number("x") > 0);
    CHECK(frames[i].number("x") + frames[i].number("width") < box[2]);
    for (const char* text : {"vertices", "ms", "1K", "100K", "10,000"}) {
      CAPTURE(i, text);
      CHECK(panels[i].text.find(text) != std::string::npos);
    }
  }
  CHECK(tops[1] > tops[0] + frames[0].number("height") + 40);
  for (const Element& text : column.all("text")) {
    if (text.text == "serial" || text.text == "device" || text.text == "paper") {
      CHECK(text.number("y") > tops[1] + frames[1].number("height") + 40);
      CHECK(text.number("y") < box[3]);
    }
  }
  // The same points, with the same words.
  REQUIRE(column.markers().size() == row.markers().size());
  for (std::size_t i = 0; i < row.markers().size(); ++i) {
    CHECK(column.markers()[i].text == row.markers()[i].text);
  }
}

TEST_CASE("a whisker spans the least to the most") {
  // The places of the least and of the most are those of the points of a second line.
  const Picture picture =
      draw(chart({{"", {series("a", {{10, Spread(20, 3, 400)}}), series("b", {exact(1, 3), exact(100, 400)})}}}));
  const std::vector<Place> places = picture.places();
  const std::vector<Element> whiskers = picture.whiskers();
  REQUIRE(places.size() == 3);
  REQUIRE(whiskers.size() == 1);
  // Cap from and to at a height, the bar's x and two heights, and the other cap.
  const std::vector<double> values = numbers(whiskers[0].attribute("d"));
  REQUIRE(values.size() == 9);
  CHECK(values[3] == places[0].x);
  CHECK(values[4] == places[1].y);
  CHECK(values[5] == places[2].y);
}

TEST_CASE("a spread too small to be seen has no whisker") {
  CHECK(draw(chart({{"", {series("a", {{1, Spread(1, 0.9999, 1.0001)}, exact(10, 1000)})}}})).whiskers().empty());
}

TEST_CASE("tooltips hold the label, the size and the numbers") {
  const std::vector<Element> markers =
      draw(chart({{"",
                   {series("GPU", {{5000, Spread(3.42, 3.41, 3.5)}, {1e6, Spread(412, 400, 420)}}),
                    series("plain", {{1500, Spread(41.2, 40, 42)}}, {"#000", Marker::none, true, false, false}),
                    series("line", {exact(1000, 7), exact(2000, 7)}, {"#000", Marker::none, true, false, false})}}}))
          .markers();
  REQUIRE(markers.size() == 5);
  CHECK(markers[0].text == "GPU, 5K: 3.42 (3.41-3.50)");
  CHECK(markers[1].text == "GPU, 1M: 412 (400-420)");
  CHECK(markers[2].text == "plain, 1.5K: 41.2 (40.0-42.0)");
  CHECK(markers[3].text == "line, 1K: 7.00 (7.00-7.00)");
  // Alone, a point is seen even where its line has no markers.
  CHECK(markers[2].attribute("fill") == "#000");
  CHECK(markers[3].attribute("fill") == "none");
  CHECK(markers[3].attribute("pointer-events") == "all");
}

TEST_CASE("the legend names a label once, in the order of the panels, and none that is not drawn") {
  const Picture picture =
      draw(chart({{"left", {series("b", {exact(1, 1)}), series("unmeasured", {}), series("a", {exact(1, 2)})}},
                  {"right", {series("c", {exact(1, 3)}), series("a", {exact(1, 2)})}}}));
  CHECK(picture.texts("unmeasured") == 0);
  std::vector<std::string> named;
  for (const Element& text : picture.all("text")) {
    if (text.text == "a" || text.text == "b" || text.text == "c") {
      named.push_back(text.text);
    }
  }
  CHECK(named == std::vector<std::string>{"b", "a", "c"});
}

TEST_CASE("labels of the legend do not overlap and are inside the picture") {
  const auto length = GENERATE(3, 30, 80, 120);
  ChartPanel panel{"", {}};
  for (int i = 0; i < 14; ++i) {
    const auto letter = static_cast<char>('a' + i);
    panel.series.push_back(series(std::string(static_cast<std::size_t>(length), letter), {exact(1, 1 + i)}));
  }
  const Picture picture = draw(chart({panel}));
  const std::vector<double> box = numbers(picture.elements.front().attribute("viewBox"));
  constexpr double letter_width = 0.55 * 13;
  std::vector<Element> labels = picture.all("text");
  std::erase_if(labels, [&](const Element& e) {
    return static_cast<int>(e.text.size()) != length || e.attribute("text-anchor") != "start";
  });
  REQUIRE(labels.size() == 14);
  for (const Element& one : labels) {
    CHECK(one.number("x") + length * letter_width < box.at(2));
    CHECK(one.number("y") < box.at(3));
    for (const Element& other : labels) {
      if (other.number("y") == one.number("y") && other.number("x") > one.number("x")) {
        CHECK(other.number("x") - one.number("x") > length * letter_width);
      } else if (&other != &one && other.number("x") == one.number("x")) {
        CHECK(std::abs(other.number("y") - one.number("y")) > 13);
      }
    }
  }
}

TEST_CASE("few sizes are labelled each, under every panel") {
  const Picture picture = draw(sample_chart());
  for (const char* label : {"1K", "5K", "10K", "50K", "100K"}) {
    CAPTURE(label);
    CHECK(picture.texts(label) == 2);
  }
  for (const char* label : {"1", "10", "100", "1,000", "10,000"}) {
    CAPTURE(label);
    CHECK(picture.texts(label) == 1);
  }
  CHECK(picture.texts("200") == 0);
}

TEST_CASE("many or crowded sizes are labelled at the decades") {
  ChartSeries many = series("many", {});
  for (int i = 0; i <= 30; ++i) {
    many.points.push_back(exact(std::pow(10, i / 5.0), 1));
  }
  const Picture of_many = draw(chart({{"", {many}}}));
  const Picture of_crowded = draw(chart({{"", {series("crowded", {exact(1, 1), exact(1.01, 1), exact(1e6, 1)})}}}));
  for (const char* label : {"1K", "10K", "100K", "1M"}) {
    CAPTURE(label);
    CHECK(of_many.texts(label) == 1);
    CHECK(of_crowded.texts(label) == 1);
  }
  CHECK(of_crowded.texts("1.01") == 0);
}

TEST_CASE("a short axis is labelled between the decades, too") {
  const Picture picture = draw(chart({{"", {series("a", {exact(1000, 0.6), exact(2000, 45)})}}}));
  for (const char* label : {"0.5", "1", "2", "5", "10", "20", "50"}) {
    CAPTURE(label);
    CHECK(picture.texts(label) == 1);
  }
}

TEST_CASE("an axis of a hundred decades has room for its labels") {
  const Picture picture = draw(chart({{"", {series("a", {exact(1e-60, 1e-50), exact(1e60, 1e50)})}}}));
  std::vector<double> heights;
  for (const Element& text : picture.all("text")) {
    if (text.attribute("text-anchor") == "end") {
      heights.push_back(text.number("y"));
    }
  }
  std::ranges::sort(heights);
  REQUIRE(heights.size() >= 3);
  for (std::size_t i = 1; i < heights.size(); ++i) {
    CHECK(heights[i] - heights[i - 1] > 14);
  }
}

TEST_CASE("one point, and points that are all equal, are drawn inside the panel") {
  const auto y = GENERATE(1e-3, 1.0, 2.0, 3.0, 9.99, 1e7);
  const auto x = GENERATE(1.0, 1000.0, 123456.0);
  CAPTURE(x, y);
  const Picture one = draw(chart({{"", {series("a", {exact(x, y)})}}}));
  const Picture equal = draw(chart({{"", {series("a", {exact(x, y), exact(10 * x, y)}), series("b", {exact(x, y)})}}}));
  CHECK(one.all("polyline").empty());
  CHECK(one.markers().size() == 1);
  CHECK(equal.all("polyline").size() == 1);
  for (const Picture& picture : {one, equal}) {
    REQUIRE(picture.frames().size() == 1);
    const Element frame = picture.frames()[0];
    for (const Place& place : picture.places()) {
      CHECK(place.x > frame.number("x") + 5);
      CHECK(place.x < frame.number("x") + frame.number("width") - 5);
      CHECK(place.y > frame.number("y") + 5);
      CHECK(place.y < frame.number("y") + frame.number("height") - 5);
    }
  }
}

TEST_CASE("a panel without points is drawn empty, a chart without points is refused") {
  CHECK(draw(chart({{"", {series("a", {exact(1, 1)})}}, {"none", {}}})).frames().size() == 2);
  CHECK_THROWS_AS(log_chart_svg(chart({})), std::invalid_argument);
  CHECK_THROWS_AS(log_chart_svg(chart({{"", {}}})), std::invalid_argument);
  CHECK_THROWS_AS(log_chart_svg(chart({{"", {series("a", {})}}})), std::invalid_argument);
}

TEST_CASE("what is not positive is refused") {
  const auto chart_with = [](double x, const Spread& y) {
    return LogChart{"id", "a chart", "x", "y", {{"panel", {{"line", {}, {{x, y}}}}}}};
  };
  CHECK_NOTHROW(log_chart_svg(chart_with(1, {1, 1, 1})));
  CHECK_THROWS_AS(log_chart_svg(chart_with(0, {1, 1, 1})), std::invalid_argument);
  CHECK_THROWS_AS(log_chart_svg(chart_with(1, {1, 0, 1})), std::invalid_argument);
  CHECK_THROWS_AS(log_chart_svg(chart_with(1, {-1, -1, -1})), std::invalid_argument);
}
