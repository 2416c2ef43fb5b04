#include "trismooth/pipeline/held_vertices.h"

#include <cstdint>
#include <vector>

#include "trismooth/base/hold.h"

#include "catch.h"

namespace hold = trismooth::hold;

TEST_CASE("vertices count for each of their reasons, and once more where there are several") {
  const auto both = [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); };
  const std::vector<std::uint8_t> reasons{0,
                                          hold::boundary,
                                          both(hold::boundary, hold::interface),
                                          hold::interface,
                                          hold::named,
                                          both(hold::non_manifold, hold::bow_tie),  // the same cause
                                          hold::bow_tie,
                                          hold::isolated,
                                          both(hold::isolated, hold::other_cell),  // used by the other cell
                                          both(hold::other_cell, hold::named)};
  const trismooth::HeldVertices held = trismooth::count_held(reasons);
  CHECK(held.boundary == 2);
  CHECK(held.interface == 2);
  CHECK(held.non_manifold == 1);
  CHECK(held.bow_tie == 1);
  CHECK(held.unused == 1);
  CHECK(held.other_cells == 2);
  CHECK(held.named == 2);
  CHECK(held.several == 2);
}
