// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "trismooth/base/cell_list.h"

namespace trismooth {

inline constexpr std::size_t most_sms_nodes = 9;

/// A card of 2dm that states an element. Its nodes run along the element's sides, a corner and a middle in turn; those
/// of cells begin with the corners.
struct SmsElement {
  std::string_view card;
  std::uint8_t type;
  std::size_t nodes;
  std::array<std::uint8_t, most_sms_nodes> order;  ///< the place on the card of each vertex of the cell
};

inline constexpr std::array sms_elements = std::to_array<SmsElement>({
    {"E3T", cell_type::triangle, 3, {0, 1, 2}},
    {"E4Q", cell_type::quad, 4, {0, 1, 2, 3}},
    {"E6T", cell_type::quadratic_triangle, 6, {0, 2, 4, 1, 3, 5}},
    {"E8Q", cell_type::quadratic_quad, 8, {0, 2, 4, 6, 1, 3, 5, 7}},
    {"E9Q", cell_type::biquadratic_quad, 9, {0, 2, 4, 6, 1, 3, 5, 7, 8}},
    {"E2L", cell_type::line, 2, {0, 1}},
    {"E3L", cell_type::quadratic_edge, 3, {0, 2, 1}},
});

}  // namespace trismooth
