#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/pipeline/region_array.h"

namespace trismooth {

/// What tells whether the values that a cell array has at the triangles of a mesh are regions. The functions are called
/// where it matters, by what has been said before, and each gives the same as often as it is asked.
struct TriangleValues {
  std::string name;
  std::size_t components = 1;
  std::int64_t triangles = 0;
  std::function<bool()> differ;                    ///< there are two different values, or more
  std::function<std::int64_t()> count;             ///< different values
  std::function<bool()> are_whole;                 ///< numbers or texts
  std::function<std::int64_t()> vertices_between;  ///< as InnerEdges::vertices_between()
  std::function<double()> fraction_between;        ///< as InnerEdges::fraction_between()
};

/// Why the array counts as one that gives regions, by the rules of find_regions(); nothing where it does not. What the
/// user should know is added to `notes`.
std::optional<RegionReason> judge_regions(const TriangleValues& values, std::vector<std::string>& notes);

/// Whether the array has a region's name and the same value everywhere: for where no other counts.
bool is_constant_region(const TriangleValues& values);

}  // namespace trismooth
