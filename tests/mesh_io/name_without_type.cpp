// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/name_without_type.h"

#include <string>
#include <utility>

#include "catch.h"

namespace trismooth {

TEST_CASE("Names lose the words for types of elements, and nothing else") {
  for (const auto& [name, rest] : {std::pair<std::string, std::string>{"copper_tri", "copper"},
                                   {"copper QUAD_4", "copper"},
                                   {"CopperQuads", "Copper"},
                                   {"air gap.tri6", "air gap"},
                                   {"Triangles", ""},
                                   {"TRI_3", ""},
                                   {"quad9-outer", "outer"},
                                   {"tri_2", "2"},
                                   {"tri_34", "34"},
                                   {"quadrant", "quadrant"},
                                   {"Tripod", "Tripod"},
                                   {"matrix", "matrix"},
                                   {"", ""},
                                   {"_", ""}}) {
    CHECK(name_without_type(name) == rest);
  }
}

}  // namespace trismooth
