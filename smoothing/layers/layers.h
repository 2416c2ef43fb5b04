// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/layers/flat_triangle.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

class Workers;

/// The search for layers: triangles that are flat on purpose, as along the walls of a flow or in thin insulation.
///
/// Flat triangles (see FlatTriangle) that are not inverted, share a side and are flat in one direction
/// (are_coherent()) belong to one *stretch*. A stretch of layers_least triangles or more is *clean* if more than half
/// of its largest angles are below 110 degrees and less than a tenth above 135: layers are made of right angles. Those
/// of meshes that are distorted, or adapted to a metric, are not, and flat triangles that are so by chance form
/// stretches of a few triangles.
///
/// Candidates for it are the flat triangles whose corners all have a second one. In random meshes these are many, so a
/// first look is at those that are left when the choice is made again and again among them, and with a further rule:
/// what is flat around each corner is so in one direction (FlatAround::is_coherent()). Only where that shows a stretch
/// of layers_least_seen does the search go on.
///
/// Nothing of it depends on the order of triangles and corners, on place or unit, or on what holds vertices.

/// The triangles of the smallest stretch that counts. Among 600,000 triangles of random points the largest clean one
/// has 9, and each further triangle is four times rarer.
inline constexpr std::int64_t layers_least = 18;
/// Of the smallest one for which the search goes on: at its ends a stretch loses some by each further choice.
inline constexpr std::int64_t layers_least_seen = 12;
/// Whether a choice, counted from 1, leaves the triangles at a vertex.
constexpr TRISMOOTH_HOST_DEVICE bool stay_in_choice(const FlatAround& around, int choice) {
  return around.count >= 2 && (choice == 1 || around.is_coherent());
}
/// How often candidates are chosen for the first look, and for the search.
inline constexpr int layers_first_choices = 4;
inline constexpr int layers_choices = 1;

/// What the search says of vertices, whatever else holds them.
struct LayerSearch {
  bool finds_any() const { return !kept.empty() || !left.empty(); }

  std::vector<std::int32_t> kept;  ///< of stretches that are to be kept, ascending
  std::vector<std::int32_t> left;  ///< of those that are to be told of, ascending: inside, where they are wide
  LayersResult result;             ///< its numbers of vertices are for whoever knows what else holds these
};

/// A flat triangle by its number.
struct ListedFlat {
  std::int32_t triangle;
  TensorUnits tensor;
};

/// The flat triangles of a mesh, and which of them are left after each choice.
class LayerCandidates {
 public:
  /// `points`: one for each vertex, in the local frame; `reversed`: one for each triangle, as MeshRings::reversed. All
  /// outlive it. `complete`: where these are the triangles of a part of a mesh, brings what is flat around vertices
  /// that another part owns; called once a choice. Complexity: linear; nearly all of the time goes into looking at all
  /// triangles once.
  LayerCandidates(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                  std::span<const std::uint8_t> reversed, Workers& workers,
                  const std::function<void(std::span<FlatAround>)>& complete = {});

  /// Those left after so many choices, 0 (all flat ones) to layers_first_choices, in the order of `triangles`.
  /// Complexity: linear in their number.
  std::vector<FlatTriangle> after(int choices, Workers& workers) const;

 private:
  TriangleView view_;
  std::array<std::vector<ListedFlat>, layers_first_choices + 1> left_;  ///< after so many choices
};

/// Looks for stretches of `least` triangles among candidates, in any order; their corners are below `vertex_count`. Not
/// with Layers::smooth. Complexity: linear in their number and, where they are many, in `vertex_count`; n log n in
/// their number where they are few.
LayerSearch search_layers(std::span<const FlatTriangle> candidates, std::int32_t vertex_count, Layers layers,
                          std::int64_t least, Workers& workers);

/// Adds to what is kept, ascending, the third corners of flat triangles that have two corners there: those at the ends
/// of a stretch, which are no candidates. Complexity: n log n in what is kept, and linear in `flat`.
void add_ends(std::span<const FlatTriangle> flat, std::vector<std::int32_t>& kept);

/// The first look, and the search where it goes on, with the ends of what is to be kept. `candidates_after(choices)`
/// lists them.
LayerSearch search_layers(const std::function<std::vector<FlatTriangle>(int)>& candidates_after,
                          std::int32_t vertex_count, Layers layers, Workers& workers);

/// Whether a vertex that is to be kept, and is held for these reasons so far, has to be held as hold::named as well: as
/// it is free or, where vertices slide, may do so.
constexpr TRISMOOTH_HOST_DEVICE bool moves_in_layer(std::uint8_t reasons, bool slides) {
  return reasons == 0 || (slides && is_held_by_lines(reasons));
}

/// Whether it has to be; counted in `result` then: by `kept` where it was free, by `kept_on_lines` else.
constexpr bool count_in_layer(std::uint8_t reasons, bool slides, LayersResult& result) {
  const bool moves = moves_in_layer(reasons, slides);
  (reasons == 0 ? result.kept : result.kept_on_lines) += moves ? 1 : 0;
  return moves;
}

/// All of it, and marks as hold::named in `fixed`, one byte a vertex, whatever is to be kept and moves_in_layer().
/// `slides`: whether vertices on lines may slide. With Layers::smooth it does nothing. `points`: one for each vertex,
/// in the local frame.
LayersResult hold_layers(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                         std::span<const std::uint8_t> reversed, Layers layers, bool slides,
                         std::span<std::uint8_t> fixed, Workers& workers);

/// The triangles of a mesh, and those into which their shorter diagonals cut its quadrilaterals.
struct CutElements {
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> reversed;  ///< one a triangle, as MeshRings::reversed
};

/// Cuts them. `points`: one for each vertex; `reversed`: one for each element. The cuts depend on the positions and on
/// the order of the numbers of corners alone. Complexity: linear.
CutElements cut_into_triangles(std::span<const Point2<double>> points, std::span<const MixedElement> elements,
                               std::span<const std::uint8_t> reversed);

/// hold_layers() of a mesh with quadrilaterals: a layer of these is one of the triangles into which they are cut, see
/// cut_into_triangles().
LayersResult hold_layers(std::span<const Point2<double>> points, std::span<const MixedElement> elements,
                         std::span<const std::uint8_t> reversed, Layers layers, bool slides,
                         std::span<std::uint8_t> fixed, Workers& workers);

}  // namespace trismooth
