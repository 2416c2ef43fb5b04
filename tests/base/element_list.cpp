// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/element_list.h"

#include <cstdint>
#include <vector>

#include "catch.h"

namespace trismooth::element_list_test {

const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 3}};
const std::vector<MixedElement> as_listed_by_four{{0, 1, 2, no_corner}, {2, 1, 3, no_corner}};
constexpr MixedElement quadrilateral{1, 4, 5, 3};

template <class Corners>
std::vector<Corners> seen(const ElementList& elements) {
  const auto listed = elements.as<Corners>();
  CHECK(listed.size() == elements.size());
  return {listed.begin(), listed.end()};
}

TEST_CASE("elements that are listed one after the other are triangles until the first quadrilateral comes") {
  for (const bool by_three : {true, false}) {
    OwnElements own;
    own.reserve(4);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      by_three ? own.append(triangles[t]) : own.append(as_listed_by_four[t]);
    }
    CHECK(seen<Triangle>(own.list()) == triangles);
    own.append(quadrilateral);
    by_three ? own.append(triangles[0]) : own.append(as_listed_by_four[0]);
    std::vector<MixedElement> all = as_listed_by_four;
    all.insert(all.end(), {quadrilateral, as_listed_by_four[0]});
    CHECK(seen<MixedElement>(own.list()) == all);
  }
  OwnElements first_of_four;
  first_of_four.append(quadrilateral);
  CHECK(seen<MixedElement>(first_of_four.list()) == std::vector{quadrilateral});
}

TEST_CASE("elements are listed as it is asked for, without a copy where they are") {
  OwnElements converted;
  CHECK(listed_as<Triangle>(triangles, converted).data() == triangles.data());
  CHECK(listed_as<MixedElement>(as_listed_by_four, converted).data() == as_listed_by_four.data());
  CHECK(converted.list().empty());
  CHECK(seen<MixedElement>(listed_as<MixedElement>(triangles, converted)) == as_listed_by_four);
  CHECK(seen<MixedElement>(converted.list()) == as_listed_by_four);
  // What is converted may be what it had.
  CHECK(seen<Triangle>(listed_as<Triangle>(converted.list(), converted)) == triangles);
  CHECK(seen<Triangle>(converted.list()) == triangles);
}

TEST_CASE("triangles that are listed by four numbers each are triangles, but not with a quadrilateral among them") {
  OwnElements converted;
  CHECK(seen<Triangle>(as_triangles_where_all_are(as_listed_by_four, converted)) == triangles);
  CHECK(as_triangles_where_all_are(triangles, converted).triangles().data() == triangles.data());
  std::vector<MixedElement> both = as_listed_by_four;
  both.push_back(quadrilateral);
  CHECK(as_triangles_where_all_are(both, converted).as<MixedElement>().data() == both.data());
  CHECK(as_triangles_where_all_are(std::vector<MixedElement>{}, converted).are_triangles());
}

TEST_CASE("what is to be kept is copied once, as it is listed") {
  OwnElements own;
  own.keep(as_listed_by_four);
  CHECK(seen<MixedElement>(own.list()) == as_listed_by_four);
  const MixedElement* const before = own.list().as<MixedElement>().data();
  CHECK(before != as_listed_by_four.data());
  own.keep(own.list());
  CHECK(own.list().as<MixedElement>().data() == before);
  own.keep(triangles);
  CHECK(seen<Triangle>(own.list()) == triangles);
  own.keep(std::vector<MixedElement>{});
  CHECK_FALSE(own.list().are_triangles());
}

}  // namespace trismooth::element_list_test
