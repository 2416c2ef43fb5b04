// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/constraints.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::constraints_test {

using Flags = std::vector<std::uint8_t>;
using Ids = std::vector<std::int32_t>;

// What is there for as long as the caller keeps it.
static_assert(std::convertible_to<Flags&, ArrayView<std::uint8_t>>);
static_assert(std::convertible_to<const Flags&, ArrayView<std::uint8_t>>);
static_assert(std::convertible_to<std::array<std::int32_t, 3>&, ArrayView<std::int32_t>>);
static_assert(std::convertible_to<std::int32_t (&)[3], ArrayView<std::int32_t>>);
static_assert(std::convertible_to<std::span<std::int32_t>, ArrayView<std::int32_t>>);
static_assert(std::convertible_to<ArrayView<std::int32_t>, std::span<const std::int32_t>>);
// A temporary is gone when the constraints are made.
static_assert(!std::convertible_to<Flags, ArrayView<std::uint8_t>>);
static_assert(!std::convertible_to<const Flags, ArrayView<std::uint8_t>>);
static_assert(!std::convertible_to<std::array<std::int32_t, 3>, ArrayView<std::int32_t>>);
static_assert(!std::convertible_to<std::vector<std::int64_t>, ArrayView<std::int32_t>>);
// Flags are flags, and numbers that are not whole are none of these.
static_assert(!std::convertible_to<Ids&, ArrayView<std::uint8_t>>);
static_assert(!std::convertible_to<std::vector<double>&, ArrayView<std::int32_t>>);

template <class Numbers>
concept IsRegions = requires(Numbers&& numbers) {
  Constraints{.regions = std::forward<Numbers>(numbers)};
};
template <class Numbers>
concept CanBeAssigned = requires(Constraints& constraints, Numbers&& numbers) {
  constraints.fixed_ids = std::forward<Numbers>(numbers);
};
static_assert(IsRegions<Ids&> && IsRegions<const Ids&> && !IsRegions<Ids>);
static_assert(CanBeAssigned<Ids&> && CanBeAssigned<const Ids&> && !CanBeAssigned<Ids>);

std::string complaint(const Constraints& constraints, std::int32_t vertices, std::int64_t triangles) {
  return message_of<std::invalid_argument>([&] { check_constraints(constraints, vertices, triangles); });
}

TEST_CASE("constraints of the right length, or none, fit") {
  const Flags flags(4, 1);
  const Ids ids{3, 0, 3};
  const Ids regions{1, 2};
  CHECK(complaint({}, 4, 2).empty());
  CHECK(complaint({.fixed = flags, .fixed_ids = ids, .other_cells = flags, .regions = regions}, 4, 2).empty());
  CHECK(complaint({.regions = regions}, 4, 3) == "Constraints::regions has 2 entries, expected 3 or none");
  CHECK(complaint({.fixed_ids = ids}, 3, 3) == "fixed vertex 3 is not one of the 3 vertices");
}

template <class T>
void check_other_type() {
  const std::vector<T> numbers{3, 0, 100};
  ArrayView<std::int32_t> view;
  {
    const Constraints constraints{.fixed_ids = numbers};
    view = constraints.fixed_ids;
  }
  CHECK(std::ranges::equal(view, Ids{3, 0, 100}));
}

TEST_CASE("whole numbers of another type are converted, and kept by every copy of the view") {
  check_other_type<std::int64_t>();
  check_other_type<std::uint64_t>();
  check_other_type<std::uint32_t>();
  check_other_type<std::int16_t>();
  check_other_type<std::uint8_t>();
  check_other_type<char>();
  const std::vector<std::int64_t> wide{7, std::int64_t{1} << 40};
  CHECK(message_of<std::invalid_argument>([&] { (void)Constraints{.regions = wide}; }) ==
        "number 1 of an array is 1099511627776, which has no place in 32 bits");
  const std::vector<std::uint32_t> high{~std::uint32_t{0}};
  CHECK(message_of<std::invalid_argument>([&] { (void)Constraints{.fixed_ids = high}; }) ==
        "number 0 of an array is 4294967295, which has no place in 32 bits");
}

TEST_CASE("constraints show the caller's numbers, not a copy") {
  Ids ids{1, 2};
  const Constraints constraints{.fixed_ids = ids};
  ids[0] = 7;
  CHECK(constraints.fixed_ids[0] == 7);
  CHECK(constraints.fixed_ids.size() == 2);
  CHECK(constraints.fixed.empty());
}

}  // namespace trismooth::constraints_test
