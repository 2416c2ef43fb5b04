// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/number_lists.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/slidable.h"
#include "trismooth/smoothing/slide/chain_runs.h"
#include "trismooth/smoothing/slide/slide_elements.h"
#include "trismooth/smoothing/slide/slide_update.h"
#include "trismooth/smoothing/slide/slide_view.h"

namespace trismooth {

/// The chains of a mesh with its vertices where they are in the input. Owns what SlideView views, but for the
/// elements. Vertices have the numbers of the Slidable, or after renumber() others.
struct SlideChains {
  std::vector<SlideChain> chains;
  std::vector<Point2<double>> knots;
  std::vector<std::int32_t> vertices;
  std::vector<std::int32_t> fan_at;  ///< of each of these vertices: its number in the Slidable
  std::vector<double> arcs;          ///< one a knot of all copies; those of the first copy count
  std::vector<std::uint8_t> bends;   ///< one a knot: 0 where the polyline is straight to rounding
  std::vector<double> lengths;       ///< one a knot: of the shorter one of both segments
  std::vector<double> limits;        ///< one a knot: how far the new line may be from the knot before it is stored...
  std::vector<double> allowed;       ///< ...and how far it may be then: rounding, of what is stored, is between
  std::vector<Slider> sliders;       ///< by colour: those of one may be updated at the same time
  std::vector<std::int32_t> batches{0};     ///< colour c has sliders batches[c] .. batches[c + 1]
  std::vector<SlidePlace> places;           ///< of the knots themselves
  const SlideElements* elements = nullptr;  ///< of others; corners have the numbers that vertices have here
  SlideCurve curve = SlideCurve::polyline;
  HeldTouching held;  ///< on none of the chains

  bool any() const { return !sliders.empty(); }
  /// Calls visit(copy, vertex) for the vertices that slide with a slider, those of all copies.
  template <class Visit>
  void for_copies(const Slider& slider, const Visit& visit) const {
    const SlideChain& chain = chains[slider.chain];
    for (std::int32_t copy = 0; copy < chain.copies; ++copy) {
      visit(copy, vertices[slider.knot + copy * chain.count]);
    }
  }
  /// Calls visit(vertex, side) for the elements of the vertices that slide with a slider.
  template <class Visit>
  void for_sides(const Slider& slider, const Visit& visit) const {
    const std::int32_t count = chains[slider.chain].count;
    for_copies(slider, [&](std::int32_t copy, std::int32_t v) {
      for (const FanSide& side : elements->around(fan_at[slider.knot + copy * count])) {
        visit(v, side);
      }
    });
  }
  /// How many vertices slide, those of all copies.
  std::int64_t vertex_count() const;
  /// What is to be said of the chains before anybody has slid.
  SlidingResult result() const;
  /// The elements that no one-ring has.
  std::span<const MixedElement> held_elements() const {
    return elements == nullptr ? std::span<const MixedElement>() : elements->held;
  }
  /// The smallest shape quotient of these, and how many of them are inverted or degenerate. `points`: of all vertices
  /// by the numbers that they have here.
  template <class T>
  T smallest_quotient(std::span<const Point2<T>> points) const {
    T smallest = std::numeric_limits<T>::infinity();
    for (const MixedElement& element : held_elements()) {
      smallest = std::min(smallest, quotient_at(element, points));
    }
    return smallest;
  }
  std::int64_t inverted(std::span<const Point2<double>> points) const {
    return std::ranges::count_if(held_elements(),
                                 [&](const MixedElement& element) { return !(quotient_at(element, points) > 0); });
  }
  /// Gives vertex v the number numbers[v]. `renumbered`: the elements, with the same numbers; they outlive the chains.
  void renumber(std::span<const std::int32_t> numbers, const SlideElements& renumbered);
  /// The neighbours of those that slide, by the numbers that vertices have here: these are from `first` to below `end`.
  NumberLists neighbours(std::int32_t first, std::int32_t end) const;
  SlideView view() const {
    return {chains.data(),
            knots.data(),
            vertices.data(),
            fan_at.data(),
            arcs.data(),
            bends.data(),
            limits.data(),
            allowed.data(),
            lengths.data(),
            sliders.data(),
            elements == nullptr ? nullptr : elements->begins.data(),
            elements == nullptr ? nullptr : elements->sides.data(),
            curve};
  }
};

/// Finds the chains: which vertices turn too much to slide on them, where they touch, which are linked; in what order
/// they are visited (greedy colouring, as colour_free_vertices() does it). Vertices have the numbers of `slidable`; so
/// have the corners of `elements`, which outlive the chains. Complexity: n log n in the vertices that may slide.
SlideChains find_slide_chains(const Slidable& slidable, const SlideElements& elements, const SlideMesh& mesh);

}  // namespace trismooth
