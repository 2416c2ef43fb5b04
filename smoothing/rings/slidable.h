// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/slidable_fans.h"

namespace trismooth {

class Workers;

/// What is to be known of a mesh's connectivity for vertices to slide, wherever they are. Vertices are numbered here
/// from 0 in the order of `vertices`: those of the elements around the vertices that may slide, and all that are held,
/// for these may lie in the same place.
struct Slidable {
  static constexpr std::int32_t none = -1;

  std::vector<std::int32_t> vertices;  ///< their numbers in the mesh, ascending
  std::vector<std::uint8_t> is_free;   ///< one flag a vertex: it moves in the plane
  /// Per vertex: the two that it has on its chain, the smaller one first; none where it cannot slide.
  std::vector<std::array<std::int32_t, 2>> neighbours;
  std::vector<MixedElement> elements;         ///< with a vertex that may slide, as they are listed
  std::vector<std::int32_t> element_numbers;  ///< of these in the mesh
  std::vector<std::array<std::int32_t, 2>> links;
  SlidableFans fans;

  Slide along = Slide::off;
  double corner_angle = 0;  ///< in degrees
  double deviation = 0;
  SlideCurve curve = SlideCurve::polyline;
  bool coincident = false;

  bool may_slide(std::int32_t vertex) const { return neighbours[static_cast<std::size_t>(vertex)][0] != none; }
  /// Whether sliding was asked for.
  bool is_wanted() const { return along != Slide::off; }
  /// Whether any vertex may slide.
  bool any() const { return !elements.empty(); }
  /// Takes the vertices that may slide out of the fixed ones. `fixed`: as MeshRings::fixed.
  std::vector<std::uint8_t> truly_fixed(std::span<const std::uint8_t> fixed) const;
  /// The flags of `elements` out of those of all elements of the mesh.
  std::vector<std::uint8_t> flags_of_elements(std::span<const std::uint8_t> flags) const;
  std::int32_t vertex_count() const { return static_cast<std::int32_t>(vertices.size()); }
};

/// An element that may be at a vertex that slides.
struct NearElement {
  std::int32_t number;
  MixedElement corners;
  std::array<std::uint8_t, 4> reasons;  ///< why its corners are fixed, as MeshRings::fixed
  std::int32_t region;                  ///< 0 where there are no regions
};

/// What find_slidable() looks at.
struct NearLines {
  std::vector<NearElement> elements;  ///< with a vertex that is_held_by_lines(), in any order
  std::vector<std::int32_t> others;   ///< the vertices that is_held_otherwise(), in any order
};

/// Has these vertices, which were free, held by something else than lines.
void hold_otherwise(NearLines& near, std::span<const std::int32_t> vertices);

/// Finds which vertices may slide as far as connectivity says it: those that nothing but a boundary, an interface or a
/// line holds, and where exactly two edges of such meet that have the same regions on their sides and the same tag.
/// None where constraints.slide says off. `fixed`: as MeshRings::fixed; the constraints have been checked. Complexity:
/// linear, and n log n in the elements of held vertices.
Slidable find_slidable(const ElementList& elements, std::span<const std::uint8_t> fixed, const Constraints& constraints,
                       Workers& workers);

/// find_slidable() from what lies at the lines.
Slidable find_slidable(NearLines near, const Sliding& slide);

}  // namespace trismooth
