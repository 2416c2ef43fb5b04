// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/element_shades.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "catch.h"
#include "picture/sample_picture.h"

namespace trismooth::element_shades_test {

PictureValue shown(const char* name) {
  return picture_value_named(name);
}

/// What is said where there is no such picture; empty where there is one.
std::string refusal(const MeshPicture& picture, const char* name) {
  try {
    const ElementShades shades(picture, shown(name), 1);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("pictures show every metric, regions and ways, and the message for others lists them") {
  for (const MetricInfo* const info : metrics_of_any_kind()) {
    CHECK(shown(std::string(info->name).c_str()).metric == info->metric);
    CHECK(PictureValue{ShownKind::metric, info->metric}.name() == info->name);
  }
  CHECK(shown("region").kind == ShownKind::region);
  CHECK(shown("moved").name() == "moved");
  std::string message;
  try {
    shown("shap");
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  for (const char* const words : {"'shap'", "did you mean 'shape'", "taper", "region or moved"}) {
    CAPTURE(words);
    CHECK(message.find(words) != std::string::npos);
  }
}

TEST_CASE("an element's shade is the colour of its place on the scale") {
  const MeshPicture picture = samples::square();
  const ElementShades shades(picture, shown("shape"), 1);
  const double shape = std::numbers::sqrt3 / 2;  // of a right-angled one with two equal sides
  for (std::size_t e = 0; e < 4; ++e) {
    CHECK(shades.value(e) == Approx(shape));
    CHECK(shades.place(e) == Approx(shape));
    CHECK(shades.colour(shades.shade(e)) == colour_at(quality_colours, 0.87));  // in steps of 0.01
  }
  const ElementShades angles(picture, shown("min_angle"), 1);
  CHECK(angles.value(0) == Approx(45));
  CHECK(angles.colour(angles.shade(0)) == colour_at(quality_colours, 0.75));
  CHECK(shades.colour(ElementShades::nothing) == Colour{255, 255, 255});
}

TEST_CASE("inverted elements have their own colour by every metric, and are worse than all others") {
  MeshPicture picture = samples::square();
  picture.before[4] = {3, 1};  // beyond the right side
  for (const MetricInfo& info : all_metrics()) {
    CAPTURE(info.name);
    const ElementShades shades(picture, {ShownKind::metric, info.metric}, 1);
    CHECK(shades.shade(1) == ElementShades::inverted);
    CHECK(shades.shade(3) < ElementShades::inverted);
    if (info.metric != Metric::area) {
      CHECK(shades.place(1) < 0);
      CHECK(shades.place(3) >= 0);
    }
  }
  picture.reversed_before = {0, 1, 0, 0};
  CHECK(ElementShades(picture, shown("shape"), 1).shade(1) < ElementShades::inverted);
}

TEST_CASE("the worse an element is, the larger is its shade") {
  MeshPicture picture = samples::square();
  picture.before[4] = {1, 0.25};  // flat below, high above
  for (const char* const name : {"shape", "min_angle", "max_angle", "aspect_ratio", "radius_ratio", "edge_ratio",
                                 "condition", "scaled_jacobian", "equiangle_skew", "area"}) {
    CAPTURE(name);
    const ElementShades shades(picture, shown(name), 1);
    CHECK(shades.shade(0) > shades.shade(2));
  }
}

TEST_CASE("areas are shown from the smallest to the largest, on a logarithmic scale") {
  MeshPicture picture = samples::square();
  picture.before[4] = {1, 0.5};  // areas 0.5, 1, 1.5, 1
  const ElementShades shades(picture, shown("area"), 1);
  CHECK(shades.range().low == Approx(0.5));
  CHECK(shades.range().high == Approx(1.5));
  CHECK(shades.colour(shades.shade(0)) == amount_colours.front().colour);
  CHECK(shades.colour(shades.shade(2)) == amount_colours.back().colour);
  CHECK(shades.colour(shades.shade(1)) == colour_at(amount_colours, 0.63));  // ln 2 / ln 3
}

TEST_CASE("ways are those of the corner that went furthest, in the file's unit") {
  MeshPicture picture = samples::square();
  picture.after = picture.before;
  picture.after[4] = {1.3, 0.6};
  const ElementShades shades(picture, shown("moved"), 1);
  CHECK(shades.value(0) == Approx(0.5));
  CHECK(shades.range().high == Approx(0.5));
  picture.after[0] = {-1, 0};
  const ElementShades more(picture, shown("moved"), 1);
  CHECK(more.value(3) == Approx(1));
  CHECK(more.colour(more.shade(3)) == amount_colours.back().colour);
  CHECK(more.colour(more.shade(1)) == colour_at(amount_colours, 0.5));
}

TEST_CASE("of a mesh that was not smoothed there is no picture of ways") {
  CHECK(refusal(samples::square(), "moved").find("nothing has moved") != std::string::npos);
}

TEST_CASE("a metric that no element has is refused, one that some have leaves the others grey") {
  const std::string message = refusal(samples::square(), "skew");
  CHECK(message.find("no element of the mesh has skew: all are triangles") != std::string::npos);
  CHECK(message.find("radius_ratio") != std::string::npos);
  const MeshPicture picture = samples::mixed();
  const ElementShades shades(picture, shown("skew"), 1);
  CHECK(shades.shade(0) == ElementShades::first);
  CHECK(shades.shade(1) == ElementShades::lacking);
  CHECK(std::isnan(shades.place(1)));
}

TEST_CASE("each kind has its own scale") {
  const MeshPicture picture = samples::mixed();
  const ElementShades shades(picture, shown("min_angle"), 1);
  CHECK(shades.shade(0) == ElementShades::first);  // 90 of 90
  CHECK(shades.place(1) == Approx(0.75));          // 45 of 60
}

TEST_CASE("regions have colours in turn") {
  const MeshPicture picture = samples::mixed();
  const ElementShades shades(picture, shown("region"), 1);
  CHECK(shades.colour(shades.shade(0)) == region_colours[0]);
  CHECK(shades.colour(shades.shade(1)) == region_colours[1]);
  const MeshPicture alone = samples::square();
  const ElementShades one(alone, shown("region"), 1);
  CHECK(one.colour(one.shade(3)) == region_colours[0]);
}

TEST_CASE("the largest and the smallest coordinates have shades as well") {
  for (const double scale : {1e300, 1e-300}) {
    MeshPicture picture = samples::square();
    for (auto& point : picture.before) {
      point = {point.x * scale, point.y * scale};
    }
    const ElementShades shades(picture, shown("shape"), 1);
    CHECK(shades.value(2) == Approx(std::sqrt(3.0) / 2));
  }
}

}  // namespace trismooth::element_shades_test
