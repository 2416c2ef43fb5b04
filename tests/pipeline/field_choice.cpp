// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/field_choice.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::field_choice_test {

trismooth::MeshDocument document() {
  trismooth::MeshDocument document;
  document.points = {0, 0, 0};
  document.point_arrays = {make_data_array("heat", 1, std::vector<double>{1}),
                           make_data_array("wind", 3, std::vector<float>{1, 2, 3}),
                           make_data_array("id", 1, std::vector<std::int32_t>{1}),
                           make_data_array("fixed", 1, std::vector<double>{1}),
                           make_data_array("h", 1, std::vector<double>{1}),
                           make_data_array("depth", 1, std::vector<double>{1}),
                           make_data_array("trismooth:displacement", 3, std::vector<double>{1, 2, 3})};
  document.arrays_of_places = {"depth"};
  return document;
}

FieldChoice chosen(std::optional<Fields> fields, const std::vector<std::string>& patterns) {
  return choose_fields(document(), {fields, patterns, "fixed", "h"});
}

using Numbers = std::vector<std::size_t>;

TEST_CASE("arrays that say something of places are interpolated by default, and others on demand") {
  CHECK(chosen({}, {}).arrays == Numbers{5});
  CHECK(chosen(Fields::keep, {}).arrays.empty());
  CHECK(chosen(Fields::interpolate, {}).arrays == Numbers{0, 1, 5});
}

TEST_CASE("patterns choose among the arrays, depths come along") {
  CHECK(chosen({}, {"heat"}).arrays == Numbers{0, 5});
  CHECK(chosen(Fields::interpolate, {"w*"}).arrays == Numbers{1, 5});
  CHECK(chosen({}, {"h*", "wind", "*"}).arrays == Numbers{0, 1, 5});
}

TEST_CASE(
    "whole numbers, what holds vertices, sizes and annotations are never interpolated, and who names them is told") {
  const FieldChoice choice = chosen({}, {"id", "fixed", "h", "trismooth:displacement", "i*"});
  CHECK(choice.arrays == Numbers{5});
  CHECK(choice.notes ==
        std::vector<std::string>{"the point array 'id' holds whole numbers: it is not interpolated",
                                 "the point array 'fixed' says which vertices are fixed: it is not interpolated",
                                 "the point array 'h' says which sizes to aim at: it is not interpolated",
                                 "the point array 'trismooth:displacement' shows what this program found: it is not "
                                 "interpolated"});
  CHECK(chosen(Fields::interpolate, {}).notes.empty());
}

TEST_CASE("a pattern that matches nothing is refused with the arrays there are") {
  CHECK(message_of<std::invalid_argument>([] { chosen({}, {"heet"}); }) ==
        "the file has no point array 'heet' to interpolate (did you mean 'heat'?); it has: heat, wind, id, fixed, h, "
        "depth, trismooth:displacement");
  CHECK(message_of<std::invalid_argument>([] {
          chosen({}, {"x*"});
        }).starts_with("the file has no point array 'x*' to interpolate; it has: heat"));
  CHECK(message_of<std::invalid_argument>([] { chosen(Fields::keep, {"heat"}); }) ==
        "--field-array names arrays to interpolate, but --fields keep keeps them all");
}

}  // namespace trismooth::field_choice_test
