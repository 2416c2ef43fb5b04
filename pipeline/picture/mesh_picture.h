// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// What pictures of a mesh show: where its vertices were and are, its elements, what holds them and which regions there
/// are. Owns all of it. Vertices that no element uses are not shown.
struct MeshPicture {
  BulkVector<Point2<double>> before;          ///< of every vertex, in the plane of the mesh, in the file's unit
  BulkVector<Point2<double>> after;           ///< where they are now; empty where nothing was smoothed
  OwnElements elements;                       ///< corners in turn, as the file lists them
  std::vector<std::uint8_t> reversed_before;  ///< per element: 1 where it is listed clockwise; empty: none is
  std::vector<std::uint8_t> reversed_after;   ///< the same in the result; empty where nothing was smoothed
  BulkVector<std::int32_t> numbers;           ///< of each element in the file, ascending; empty: they count from 0
  std::vector<std::int32_t> regions;          ///< of each element, places in region_names; empty: there is one
  std::vector<std::string> region_names;      ///< text, as files have it
  std::vector<std::uint8_t> held;             ///< per vertex: bits of namespace hold, 0 where it is free; or empty
  std::vector<std::int64_t> worst_before;     ///< numbers of the worst elements, the worst first
  std::vector<std::int64_t> worst_after;      ///< those of the result; empty where nothing was smoothed
  /// Where a place of the plane is for people: longitude and latitude of a map. Empty: it is itself.
  std::function<Point2<double>(Point2<double>)> shown_place;
  /// The place in the plane of what people name so; empty: it is itself.
  std::function<Point2<double>(Point2<double>)> place_shown;

  /// Where the vertices are now.
  [[nodiscard]] const BulkVector<Point2<double>>& now() const { return after.empty() ? before : after; }
  /// The place of the element with that number. Complexity: logarithmic.
  [[nodiscard]] std::size_t place_of(std::int64_t number) const {
    return numbers.empty() ? static_cast<std::size_t>(number)
                           : static_cast<std::size_t>(std::ranges::lower_bound(numbers, number) - numbers.begin());
  }
  /// Which elements are listed clockwise now.
  [[nodiscard]] const std::vector<std::uint8_t>& reversed_now() const {
    return after.empty() ? reversed_before : reversed_after;
  }
};

}  // namespace trismooth
