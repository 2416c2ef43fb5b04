// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/array_view.h"
#include "trismooth/base/enum_text.h"

namespace trismooth {

/// Whether vertices of boundaries and interfaces move along them.
enum class Slide : std::uint8_t {
  off,       ///< they stay where they are
  straight,  ///< on stretches that are straight to rounding: the line stays the same set of points
  curves,    ///< on all of them, as far as the deviation allows: straight stretches, and round them a little
};

/// What vertices slide on.
enum class SlideCurve : std::uint8_t {
  polyline,  ///< the edges as they are in the input
  spline,    ///< a smooth curve through the vertices as they are in the input; with Slide::curves
};

template <>
struct EnumText<Slide> {
  static constexpr std::string_view what = "setting of sliding";
  static constexpr std::array<std::pair<Slide, std::string_view>, 3> texts{
      {{Slide::off, "off"}, {Slide::straight, "straight"}, {Slide::curves, "curves"}}};
};
template <>
struct EnumText<SlideCurve> {
  static constexpr std::string_view what = "curve";
  static constexpr std::array<std::pair<SlideCurve, std::string_view>, 2> texts{
      {{SlideCurve::polyline, "polyline"}, {SlideCurve::spline, "spline"}}};
};

/// How vertices of boundaries and interfaces slide. All views; see Constraints.
///
/// Edges with one triangle, those between two regions and those of `lines` form chains: runs of edges that have the
/// same regions on their sides and the same line tag. A vertex slides where exactly two such edges meet and nothing
/// else holds it; where it does not, chains end: at junctions, at changes of region or tag, and at corners.
struct Sliding {
  Slide along = Slide::off;
  /// A vertex where a chain turns by more than this, in degrees from 0 to 180, is a corner.
  double corner_angle = 30;
  /// With Slide::curves: how far the new line may be from the old one, and the old one from it, as a part of the length
  /// of the edge nearby (of the shorter one at a vertex). 0: as Slide::straight. Checked in the result, as it is
  /// stored.
  double deviation = 1e-3;
  SlideCurve curve = SlideCurve::polyline;
  /// Lines that the mesh has beside its triangles, two vertex numbers each: chains run along them, inside a region,
  /// too. Their vertices are held fixed where they do not slide, whatever `along` says.
  ArrayView<std::int32_t> lines{};
  /// One number a line; a chain ends where it changes. Empty: all are the same.
  ArrayView<std::int32_t> line_tags{};
  /// Pairs of vertices that slide as one, as those of two sides that are periodic: both at the same part of the same
  /// edge of their chains. Chains that are not linked vertex by vertex from end to end, the ends as well, stay where
  /// they are; so do linked vertices that are on none.
  ArrayView<std::int32_t> links{};
  /// Vertices of several chains that lie in the same place without being one, as on the two faces of a crack, slide as
  /// if linked. Else they stay where they are. Those within a thousandth of the shortest edge of their chains count as
  /// in the same place; on splines they stay all the same. Vertices that are as near to an edge of another chain, and
  /// the ends of such edges, stay in any case.
  bool coincident = false;

  /// Throws std::invalid_argument for an angle or a deviation that is none.
  void validate() const;
  /// Whether vertices are named in it.
  [[nodiscard]] bool names_vertices() const { return !lines.empty() || !links.empty(); }
};

}  // namespace trismooth
