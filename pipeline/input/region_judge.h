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

/// How the user says what gives regions: the notes name it as the way out.
struct RegionWords {
  std::string (*takes)(const std::string& array);  ///< that this array does: "--region-array matl"
  std::string none;                                ///< that none does: "--region-array none"
};

/// Those of the program.
RegionWords program_words();

/// Why the array counts as one that gives regions, by the rules of find_regions(); nothing where it does not. What the
/// user should know is added to `notes`, one sentence each. This is the one judge: of the program, on one rank or many,
/// and of the Python package, which has its own words. Complexity: that of the functions of `values`.
std::optional<RegionReason> judge_regions(const TriangleValues& values, std::vector<std::string>& notes,
                                          const RegionWords& words = program_words());

/// Whether the array has a region's name and the same value everywhere: for where no other counts.
bool is_constant_region(const TriangleValues& values);

}  // namespace trismooth
