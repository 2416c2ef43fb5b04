// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/fixed_array.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::fixed_array_test {

using Bytes = std::vector<std::uint8_t>;

MeshDocument six_points() {
  MeshDocument document;
  document.points.assign(18, 0.0);
  return document;
}

TEST_CASE("a point array fixes the vertices where any of its components is not zero") {
  MeshDocument document = six_points();
  document.point_arrays.push_back(make_data_array("fixed", 1, std::vector<double>{0, 1, -0.0, -1, 1e-300, 0}));
  document.point_arrays.push_back(
      make_data_array("two", 2, std::vector<std::uint8_t>{0, 0, 0, 1, 2, 0, 0, 0, 3, 3, 0, 0}));
  for (const auto& name : {std::optional<std::string>(), std::optional<std::string>("fixed")}) {
    const FixedArray fixed = find_fixed_array(document, name);
    CHECK(fixed.array == "fixed");
    CHECK(fixed.flags == Bytes{0, 1, 0, 1, 1, 0});
    CHECK(fixed.vertices == 3);
  }
  CHECK(find_fixed_array(document, "TWO").flags == Bytes{0, 1, 1, 0, 1, 0});
}

TEST_CASE("the array called fixed counts in whatever case; what the program added to show what it held does not") {
  MeshDocument document = six_points();
  document.point_arrays.push_back(make_data_array("trismooth:fixed", 1, Bytes(6, 1)));
  CHECK(find_fixed_array(document, std::nullopt).array.empty());
  document.point_arrays.push_back(make_data_array("Fixed", 1, Bytes{0, 0, 1, 0, 0, 0}));
  CHECK(find_fixed_array(document, std::nullopt).flags == Bytes{0, 0, 1, 0, 0, 0});
  CHECK(find_fixed_array(document, std::nullopt).array == "Fixed");
  CHECK(find_fixed_array(document, "trismooth:fixed").vertices == 6);
}

TEST_CASE("a missing point array fixes nothing, unless it is named") {
  MeshDocument document = six_points();
  document.point_arrays.push_back(make_data_array("depth", 1, std::vector<float>(6, 1)));
  document.cell_arrays.push_back(make_data_array("fixed", 1, std::vector<float>(5, 1)));
  const FixedArray none = find_fixed_array(document, std::nullopt);
  CHECK(none.flags.empty());
  CHECK(none.array.empty());
  CHECK(none.vertices == 0);
  const std::string message = message_of<std::invalid_argument>([&] { find_fixed_array(document, "fixed"); });
  CHECK(message.find("'fixed'") != std::string::npos);
  CHECK(message.find("it has: depth") != std::string::npos);
  CHECK(message.find("none holds nothing by an array") != std::string::npos);
}

TEST_CASE("no array fixes vertices where none is asked to") {
  MeshDocument document = six_points();
  document.point_arrays.push_back(make_data_array("fixed", 1, std::vector<float>(6, 1)));
  CHECK(find_fixed_array(document, std::nullopt).vertices == 6);
  CHECK(find_fixed_array(document, "none").flags.empty());
  CHECK(find_fixed_array(document, "none").array.empty());
}

}  // namespace trismooth::fixed_array_test
