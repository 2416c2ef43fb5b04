// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/field_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/dice.h"
#include "support/test_meshes.h"

using trismooth::DataArray;
using trismooth::interpolated;
using trismooth::interpolated_value;
using trismooth::make_data_array;
using trismooth::MeshPlace;
using trismooth::Triangle;
using trismooth::Workers;

namespace field_transfer_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST_CASE("a value never leaves the range of the corners, and is theirs at a corner") {
  test_meshes::Random dice(3);
  for (int round = 0; round < 10000; ++round) {
    const std::array<double, 3> corners{dice.between(0, 1), dice.between(0, 1) * 1e-3,
                                        round % 2 == 0 ? dice.between(0, 1) : 0.1};
    double u = dice.between(0, 1);
    double v = dice.between(0, 1) * (1 - u);
    const double value = interpolated_value(corners, {u, v, 1 - u - v});
    CHECK(value >= *std::ranges::min_element(corners));
    CHECK(value <= *std::ranges::max_element(corners));
    CHECK(interpolated_value({0.1, 0.1, 0.1}, {u, v, 1 - u - v}) == 0.1);
  }
  CHECK(interpolated_value({1, 0.1, 3}, {0, 1, 0}) == 0.1);
  const double largest = std::numeric_limits<double>::max();
  CHECK(interpolated_value({largest, largest, largest}, {0.4, 0.3, 0.30000000000000004}) == largest);
}

TEST_CASE("what is no number stays where it is") {
  CHECK(interpolated_value({nan, 2, 4}, {0, 0.5, 0.5}) == 3);
  CHECK(std::isnan(interpolated_value({nan, 2, 4}, {0.1, 0.4, 0.5})));
  CHECK(interpolated_value({infinity, 2, 4}, {0, 0.5, 0.5}) == 3);
  CHECK(interpolated_value({infinity, 2, 4}, {0.5, 0.5, 0}) == infinity);
}

TEST_CASE("each component is alone, others keep their bits, and float32 stays float32") {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}};
  const std::vector<std::int32_t> vertices{3, 0, 1};
  const std::vector<MeshPlace> places{{0, {0.5, 0.25, 0.25}}, {1, {0, 0, 1}}, {}};
  Workers workers(1);
  const DataArray wind = make_data_array("wind", 2, std::vector<float>{1, 10, 2, 20, 0.1F, 40, 8, 80});
  const DataArray result = interpolated(wind, triangles, vertices, places, workers).array;
  CHECK(result.name == "wind");
  CHECK(result.type == trismooth::ScalarType::float32);
  const auto values = result.as<float>();
  CHECK(std::vector<float>(values.begin(), values.end()) ==
        std::vector<float>{0.1F, 40, 2, 20, 0.1F, 40, static_cast<float>(1.0 + static_cast<double>(0.1F) / 4), 20});
  CHECK(wind.as<float>()[0] == 1);
}

}  // namespace field_transfer_test

TEST_CASE("values that stand for none are never blended: a vertex beside one keeps its own") {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}};
  const std::vector<std::int32_t> vertices{0, 3};
  const std::vector<MeshPlace> places{{0, {0.25, 0.5, 0.25}}, {1, {0.5, 0.25, 0.25}}};
  trismooth::Workers workers(2);
  for (const double none : {-99999.0, -9999.0, -999.0, 99999.0, 1e20, 1e30, -1e30, 9.969209968386869e36,
                            std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                            static_cast<double>(std::numeric_limits<float>::max()),
                            // Surfer, ESRI and NetCDF with fewer digits, LAS, and 1e20 of float32 read as float64.
                            1.70141e38, 1.701410009187828e38, -3.40282e38, -3.4028235e38, -3.4e38, 9.96921e36,
                            2.14748e9, -999.25, -9999.25, 1.0000000200408773e20}) {
    CAPTURE(none);
    // Vertex 0 has none and is of the first triangle alone.
    const std::vector<double> read{none, 4, 8, 16};
    const DataArray field = trismooth::make_data_array("depth", 1, std::vector<double>(read));
    const auto result = interpolated(field, triangles, vertices, places, workers);
    CHECK(result.kept_vertices == 1);
    CHECK(result.array.value(3) == 8);
    CHECK(std::memcmp(result.array.bytes.data(), field.bytes.data(), sizeof(double)) == 0);
    CHECK_FALSE(result.missing.empty());
    // In single precision too, where its type can hold it.
    const DataArray single =
        trismooth::make_data_array("depth", 1, std::vector<float>{static_cast<float>(none), 4, 8, 16});
    CHECK(interpolated(single, triangles, vertices, places, workers).kept_vertices == 1);
  }
}

TEST_CASE("numbers that only look like none are numbers: those that others stand beside") {
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<std::int32_t> vertices{0};
  const std::vector<MeshPlace> places{{0, {0.5, 0.5, 0}}};
  trismooth::Workers workers(1);
  struct Case {
    std::vector<double> values;
    double expected;
  };
  for (const Case& c :
       {Case{{-9999, -9500, 0, -12000}, -9749.5}, Case{{999, 1, 5, 7}, 500}, Case{{-999, -950, 0, 3}, -974.5},
        Case{{-9999, -9999, -9999, -9999}, -9999}, Case{{1e30, 2e30, 5e30, 1.05e30}, 1.5e30},
        // Pressures of 1 bar beside none.
        Case{{1e5, 0, 0, 0}, 5e4}, Case{{999.25, 0, 1, 3}, 499.625}}) {
    CAPTURE(c.values);
    const DataArray field = trismooth::make_data_array("field", 1, std::vector<double>(c.values));
    const auto result = interpolated(field, triangles, vertices, places, workers);
    CHECK(result.kept_vertices == 0);
    CHECK(result.array.value(0) == Approx(c.expected).epsilon(1e-14));
  }
}

TEST_CASE("each component is judged alone: a depth of none beside large discharges is none") {
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<std::int32_t> vertices{0};
  const std::vector<MeshPlace> places{{0, {0.5, 0.5, 0}}};
  trismooth::Workers workers(1);
  const DataArray field =
      trismooth::make_data_array("flow", 2, std::vector<double>{-22500, -9999, 22500, 4, 100, 5, 0, 6});
  const auto result = interpolated(field, triangles, vertices, places, workers);
  CHECK(result.array.as<double>()[0] == 0);
  CHECK(result.array.as<double>()[1] == -9999);
  CHECK(result.kept_vertices == 1);
  CHECK(result.missing == "-9999");
}

TEST_CASE("values that stand for none are named as the array holds them, each once") {
  trismooth::Workers workers(1);
  const auto missing_in = [&workers](const DataArray& field) {
    return interpolated(field, {}, {}, {}, workers).missing;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(missing_in(trismooth::make_data_array("d", 1, std::vector<double>{1, infinity, 2})) == "inf");
  CHECK(missing_in(trismooth::make_data_array("d", 1, std::vector<double>{1, -infinity, -999.25})) == "-999.25, -inf");
  CHECK(missing_in(trismooth::make_data_array("d", 2, std::vector<double>{1, -9999, -9999, 2, std::nan(""), 3})) ==
        "-9999, nan");
  CHECK(missing_in(trismooth::make_data_array("d", 1, std::vector<float>{1, 99999.9F, -3.40282e38F})) ==
        "-3.40282e+38, 99999.9");
}
