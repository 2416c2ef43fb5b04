// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/odd_quads.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <utility>

#include "trismooth/base/element_list.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/pipeline/input/cell_copies.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

/// visit(number, corners) of the quadrilaterals.
template <class Visit>
void for_quads(const ElementList& elements, const Visit& visit) {
  elements.visit([&]<class Corners>(std::span<const Corners> listed) {
    if constexpr (std::same_as<Corners, MixedElement>) {
      for (std::size_t e = 0; e < listed.size(); ++e) {
        if (listed[e][3] != no_corner) {
          visit(e, listed[e]);
        }
      }
    }
  });
}

/// Two corners, the smaller one first.
using Pair = std::pair<std::int32_t, std::int32_t>;

Pair pair_of(std::int32_t a, std::int32_t b) {
  return std::minmax({a, b});
}

/// Whether the corners turn one way all around: then no other order of them could.
bool is_convex(std::span<const Point2<double>> points, const MixedElement& quad) {
  const auto [a, b, c, d] = points_of(quad, points);
  const auto turn = [](Point2<double> side, Point2<double> next) { return side.x * next.y - side.y * next.x; };
  const std::array sides{b - a, c - b, d - c, a - d};
  const std::array turns{turn(sides[0], sides[1]), turn(sides[1], sides[2]), turn(sides[2], sides[3]),
                         turn(sides[3], sides[0])};
  const auto [least, most] = std::minmax({turns[0], turns[1], turns[2], turns[3]});
  return least > 0 || most < 0;
}

/// How often pairs of corners that are asked for are sides of elements, and diagonals.
class PairUses {
 public:
  PairUses(const ElementList& elements, const std::vector<std::int32_t>& quads) {
    for (const std::int32_t q : quads) {
      const auto corners = elements[static_cast<std::size_t>(q)];
      for (std::size_t i = 0; i < 4; ++i) {
        pairs_.push_back(pair_of(corners[i], next_corner(corners, i)));
      }
      pairs_.push_back(pair_of(corners[0], corners[2]));
      pairs_.push_back(pair_of(corners[1], corners[3]));
    }
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    as_sides_.resize(pairs_.size(), 0);
    as_diagonals_.resize(pairs_.size(), 0);
    for (const auto corners : elements) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        count(pair_of(corners[i], next_corner(corners, i)), as_sides_);
      }
    }
    for (const std::int32_t q : quads) {
      const auto corners = elements[static_cast<std::size_t>(q)];
      count(pair_of(corners[0], corners[2]), as_diagonals_);
      count(pair_of(corners[1], corners[3]), as_diagonals_);
    }
  }

  /// Whether elements beside the quadrilateral have one of its diagonals for a side, and none has two opposite sides.
  bool tell_another_order(std::span<const std::int32_t> quad) const {
    return (is_side_beside(quad, 0) || is_side_beside(quad, 1)) &&
           ((is_its_own(quad, 0) && is_its_own(quad, 2)) || (is_its_own(quad, 1) && is_its_own(quad, 3)));
  }
  /// Whether they may, by what is known at corner i: the elements around it.
  bool may_tell_another_order(std::span<const std::int32_t> quad, std::size_t i) const {
    return is_side_beside(quad, i % 2) && (is_its_own(quad, i) || is_its_own(quad, (i + 3) % 4));
  }

 private:
  /// Whether another element has the diagonal from corner i on for a side.
  bool is_side_beside(std::span<const std::int32_t> quad, std::size_t i) const {
    const std::size_t pair = place(pair_of(quad[i], quad[i + 2]));
    return as_sides_[pair] > 0 || as_diagonals_[pair] > 1;
  }
  /// Whether no other element has the side from corner i on.
  bool is_its_own(std::span<const std::int32_t> quad, std::size_t i) const {
    return as_sides_[place(pair_of(quad[i], next_corner(quad, i)))] == 1;
  }
  std::size_t place(Pair pair) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(pairs_, pair) - pairs_.begin());
  }
  void count(Pair pair, std::vector<std::int32_t>& uses) const {
    const std::size_t found = place(pair);
    if (found < pairs_.size() && pairs_[found] == pair) {
      ++uses[found];
    }
  }

  std::vector<Pair> pairs_;
  std::vector<std::int32_t> as_sides_;
  std::vector<std::int32_t> as_diagonals_;
};

std::vector<std::int32_t> quads_not_convex(std::span<const Point2<double>> points, const ElementList& elements) {
  std::vector<std::int32_t> found;
  for_quads(elements, [&](std::size_t e, const MixedElement& quad) {
    if (!is_convex(points, quad)) {
      found.push_back(static_cast<std::int32_t>(e));
    }
  });
  return found;
}

/// Those of the elements that are not listed in turn, ascending.
std::vector<std::int32_t> quads_not_in_turn(const PlanarMesh& mesh) {
  std::vector<std::int32_t> found = quads_not_convex(mesh.points, mesh.elements);
  if (!found.empty()) {
    const PairUses uses(mesh.elements, found);
    std::erase_if(found,
                  [&](std::int32_t e) { return !uses.tell_another_order(mesh.elements[static_cast<std::size_t>(e)]); });
  }
  return found;
}

}  // namespace

void hold_crossed_quads(PlanarMesh& mesh) {
  if (mesh.elements.are_triangles()) {
    return;
  }
  const std::vector<std::int32_t> crossed = quads_not_in_turn(mesh);
  if (crossed.empty()) {
    return;
  }
  mesh.notes.push_back(
      counted(crossed.size(), "quadrilateral does not list its corners in turn",
              "quadrilaterals do not list their corners in turn") +
      " (the first is cell " + std::to_string(mesh.cells[static_cast<std::size_t>(crossed.front())]) +
      "): inverted, and kept as they are, their vertices held fixed; with corners in turn they are smoothed");
  for (const std::int32_t element : crossed) {
    hold_as_other_cell(mesh, element);
  }
  mesh.crossed_quads = std::ssize(crossed);
  leave_out(mesh, crossed);
  mesh.elements = as_triangles_where_all_are(mesh.elements, mesh.listed);
}

bool may_have_crossed_quads(std::span<const Point2<double>> points, const ElementList& elements,
                            std::span<const std::uint8_t> ghosts) {
  const std::vector<std::int32_t> found = quads_not_convex(points, elements);
  if (found.empty()) {
    return false;
  }
  const PairUses uses(elements, found);
  return std::ranges::any_of(found, [&](std::int32_t e) {
    const auto quad = elements[static_cast<std::size_t>(e)];
    for (std::size_t i = 0; i < 4; ++i) {
      if (ghosts[static_cast<std::size_t>(quad[i])] == 0 && uses.may_tell_another_order(quad, i)) {
        return true;
      }
    }
    return false;
  });
}

ThinQuads find_thin_quads(const PlanarMesh& mesh, std::span<const double> points, std::span<const std::uint8_t> held) {
  ThinQuads thin;
  const auto coincide = [points](std::int32_t a, std::int32_t b) {
    const double* const first = points.data() + 3 * static_cast<std::size_t>(a);
    const double* const second = points.data() + 3 * static_cast<std::size_t>(b);
    return first[0] == second[0] && first[1] == second[1] && first[2] == second[2];
  };
  for_quads(mesh.elements, [&](std::size_t /*quad*/, const MixedElement& quad) {
    const auto& [a, b, c, d] = quad;
    const bool is_thin = (coincide(a, b) && coincide(c, d)) || (coincide(b, c) && coincide(d, a));
    const auto is_held = [held](std::int32_t v) { return !held.empty() && held[static_cast<std::size_t>(v)] != 0; };
    if (is_thin && !coincide(a, c) && !std::ranges::all_of(quad, is_held)) {
      ++thin.count;
      thin.flags.resize(points.size() / 3, 0);
      for (const std::int32_t v : quad) {
        thin.flags[static_cast<std::size_t>(v)] = 1;
      }
    }
  });
  return thin;
}

}  // namespace trismooth
