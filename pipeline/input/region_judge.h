// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/pipeline/region_array.h"

namespace trismooth {

/// In place of names of arrays: no array gives regions.
inline constexpr std::string_view no_region_arrays = "none";

/// What tells whether the values that a cell array has at the triangles of a mesh are regions. The functions are called
/// where it matters, by what has been said before, and each gives the same as often as it is asked. Of a mesh in pieces
/// each may be collective: all ranks ask the same.
struct TriangleValues {
  std::string name;
  std::size_t components = 1;  ///< of several none of the functions is called
  std::int64_t triangles = 0;
  std::function<bool()> differ;                    ///< there are two different values, or more
  std::function<std::int64_t()> count;             ///< different values
  std::function<bool()> are_whole;                 ///< numbers or texts
  std::function<std::int64_t()> vertices_between;  ///< as InnerEdges::vertices_between()
  std::function<double()> fraction_between;        ///< as InnerEdges::fraction_between()
};

/// Whose arrays they are, in messages.
struct ArrayOwner {
  std::string_view has = "the file has";
  std::string_view it_has = "it has";
};

/// Calls obey(place among `arrays`, why) for each that gives regions, in their order: where `names` is empty those that
/// do by the rules of find_regions(), else those of these names, in the order of the names and each once. `names` may
/// be no_region_arrays alone. `sizes`: the one that the user wants for another purpose, or empty. What the user should
/// know is added to `notes`, one sentence each.
///
/// This is the one judge: of the program, on one rank or many, of the library and of the Python package.
///
/// Throws std::invalid_argument for a name that no array has, with those there are, for an array of several components
/// that is named, and for no_region_arrays beside other names. Complexity: that of the functions of `arrays`.
void choose_regions(std::span<const TriangleValues> arrays, std::span<const std::string> names, std::string_view sizes,
                    const std::function<void(std::size_t, RegionReason)>& obey, std::vector<std::string>& notes,
                    const ArrayOwner& owner = {});

/// What a region is called; with the value where others are called the same.
struct RegionName {
  std::string plain;
  std::string with_value;
};

/// The names of the regions, of which no two that are called the same go without their values.
std::vector<std::string> tell_apart(std::vector<RegionName> names);

}  // namespace trismooth
