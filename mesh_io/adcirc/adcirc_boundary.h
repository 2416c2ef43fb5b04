// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trismooth {

/// A boundary of an ADCIRC grid: what its set of points says by its name.
struct AdcircBoundary {
  bool is_open = false;
  std::size_t number = 0;  ///< among the open boundaries, or among the others, from 1
  std::int64_t type = 0;   ///< IBTYPEE or IBTYPE
};

/// Whether water flows over boundaries of that IBTYPE, so that each of their nodes has a height and coefficients.
bool is_adcirc_weir(std::int64_t type);

/// Whether each node of boundaries of that IBTYPE has another one across from it.
bool has_adcirc_pairs(std::int64_t type);

/// "open boundary 1", "land boundary 2 (type 20)", "weir 3 (type 24)".
std::string name_of(const AdcircBoundary& boundary);

/// The boundary that a set of points is by its name, or nothing; also where the name is not exactly that of name_of().
std::optional<AdcircBoundary> parse_adcirc_boundary(std::string_view name);

}  // namespace trismooth
