// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/slidable.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <iterator>
#include <utility>

#include "trismooth/base/number_lists.h"
#include "trismooth/base/number_places.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/rings/near_lines.h"

namespace trismooth {

namespace {

/// What an edge is a part of: chains end where this changes.
struct ChainKind {
  std::int32_t low_region = 0;
  std::int32_t high_region = 0;
  bool is_boundary = false;
  bool is_line = false;
  std::int32_t tag = 0;

  bool operator==(const ChainKind&) const = default;
};

/// A side of an element between two vertices that are held. Vertices are numbered from 0 as NumberPlaces says.
struct EdgeSide {
  std::int32_t low, high, region;
  auto operator<=>(const EdgeSide&) const = default;
};

struct Line {
  std::int32_t low, high, tag;
  auto operator<=>(const Line&) const = default;
};

/// Elements at lines, their vertices numbered from 0 in their order.
class NearMesh {
 public:
  /// `others`: vertices that no line is at.
  NearMesh(std::span<const NearElement> near, std::span<const std::int32_t> others)
      : near_(near), places_(vertices_of(near, others)) {
    // (What holds the others is nothing that lines ask for.)
    reasons_.assign(places_.sorted().size(), hold::named);
    elements_.reserve(near.size());
    for (const NearElement& element : near) {
      MixedElement corners = element.corners;
      for (std::size_t i = 0; i < corners_of(element.corners).size(); ++i) {
        corners[i] = places_.of(element.corners[i]);
        reasons_[corners[i]] = element.reasons[i];
      }
      elements_.push_back(corners);
    }
  }

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(reasons_.size()); }
  std::size_t size() const { return elements_.size(); }
  const MixedElement& element(std::size_t e) const { return elements_[e]; }
  std::span<const std::int32_t> corners(std::size_t e) const { return corners_of(elements_[e]); }
  std::int32_t region(std::size_t e) const { return near_[e].region; }
  std::int32_t number(std::size_t e) const { return near_[e].number; }
  bool is_free(std::int32_t v) const { return reasons_[v] == 0; }
  bool is_candidate(std::int32_t v) const { return is_held_by_lines(reasons_[v]); }
  /// The number here of a vertex of the mesh; NumberPlaces::none where it is at none of these elements.
  std::int32_t vertex(std::int32_t number_in_mesh) const { return places_.of(number_in_mesh); }
  std::int32_t number_in_mesh(std::int32_t v) const { return places_.sorted()[v]; }

 private:
  static std::vector<std::int32_t> vertices_of(std::span<const NearElement> near,
                                               std::span<const std::int32_t> others) {
    std::vector<std::int32_t> vertices(others.begin(), others.end());
    vertices.reserve(others.size() + 4 * near.size());
    for (const NearElement& element : near) {
      std::ranges::copy(corners_of(element.corners), std::back_inserter(vertices));
    }
    return vertices;
  }

  std::span<const NearElement> near_;
  NumberPlaces places_;
  std::vector<MixedElement> elements_;
  std::vector<std::uint8_t> reasons_;
};

/// Finds the chains' edges at the vertices that nothing else holds.
class ChainSearch {
 public:
  ChainSearch(const NearMesh& mesh, const Sliding& slide) : mesh_(mesh), blocked_(vertices()) {
    list_lines(slide);
    find_edges();
  }

  /// The two neighbours of each vertex on its chain, the smaller one first; none where it cannot slide.
  std::vector<std::array<std::int32_t, 2>> neighbours() const {
    std::vector<std::array<std::int32_t, 2>> found(vertices(), {Slidable::none, Slidable::none});
    std::vector<std::pair<std::int32_t, std::int32_t>> ends;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      ends.emplace_back(edges_[e].low, static_cast<std::int32_t>(e));
      ends.emplace_back(edges_[e].high, static_cast<std::int32_t>(e));
    }
    const NumberLists edges_at(0, mesh_.vertex_count(), ends);
    for (std::int32_t v = 0; v < mesh_.vertex_count(); ++v) {
      const std::span<const std::int32_t> here = edges_at[v];
      if (here.size() != 2 || !mesh_.is_candidate(v) || blocked_[v] != 0) {
        continue;
      }
      const ChainEdge& first = edges_[here[0]];
      const ChainEdge& second = edges_[here[1]];
      if (first.kind == second.kind) {
        const auto [low, high] = std::minmax({first.other(v), second.other(v)});
        found[v] = {low, high};
      }
    }
    return found;
  }

 private:
  struct ChainEdge {
    std::int32_t low, high;
    ChainKind kind;

    std::int32_t other(std::int32_t v) const { return v == low ? high : low; }
  };

  std::size_t vertices() const { return static_cast<std::size_t>(mesh_.vertex_count()); }

  /// Lines with a vertex here; one that has no other here is no edge of these elements.
  void list_lines(const Sliding& slide) {
    for (std::size_t i = 0; i < slide.lines.size() / 2; ++i) {
      const std::int32_t a = mesh_.vertex(slide.lines[2 * i]);
      const std::int32_t b = mesh_.vertex(slide.lines[2 * i + 1]);
      if (a == NumberPlaces::none || b == NumberPlaces::none) {
        block(a);
        block(b);
      } else {
        lines_.push_back({std::min(a, b), std::max(a, b), slide.line_tags.empty() ? 0 : slide.line_tags[i]});
      }
    }
    std::ranges::sort(lines_);
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
  }

  void block(std::int32_t v) {
    if (v != NumberPlaces::none) {
      blocked_[v] = 1;
    }
  }
  void block(const Line& line) {
    block(line.low);
    block(line.high);
  }

  void find_edges() {
    std::vector<EdgeSide> sides;
    for (std::size_t e = 0; e < mesh_.size(); ++e) {
      const std::span<const std::int32_t> corners = mesh_.corners(e);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t from = corners[i];
        const std::int32_t to = next_corner(corners, i);
        if (!mesh_.is_free(from) && !mesh_.is_free(to) && (mesh_.is_candidate(from) || mesh_.is_candidate(to))) {
          sides.push_back({std::min(from, to), std::max(from, to), mesh_.region(e)});
        }
      }
    }
    std::ranges::sort(sides);
    auto line = lines_.begin();
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      const EdgeSide& first = sides[begin];
      while (end < sides.size() && sides[end].low == first.low && sides[end].high == first.high) {
        ++end;
      }
      const auto edge = std::pair(first.low, first.high);
      // Lines beside the edges: what they are on is no edge of these elements.
      for (; line != lines_.end() && std::pair(line->low, line->high) < edge; ++line) {
        block(*line);
      }
      const auto first_line = line;
      for (; line != lines_.end() && std::pair(line->low, line->high) == edge; ++line) {
      }
      const auto lines_here = line - first_line;
      if (lines_here > 1) {
        block(*first_line);  // tags that contradict each other
      }
      add_edge(std::span(sides).subspan(begin, end - begin), lines_here > 0 ? &*first_line : nullptr);
    }
    std::for_each(line, lines_.end(), [this](const Line& beside) { block(beside); });
  }

  /// `sides`: all of one edge.
  void add_edge(std::span<const EdgeSide> sides, const Line* line) {
    const EdgeSide& edge = sides.front();
    const std::int32_t low = edge.region;  // (they are sorted)
    const std::int32_t high = sides.back().region;
    const bool is_boundary = sides.size() == 1;
    if (sides.size() > 2 || (!is_boundary && low == high && line == nullptr)) {
      return;
    }
    edges_.push_back({edge.low, edge.high, {low, high, is_boundary, line != nullptr, line != nullptr ? line->tag : 0}});
  }

  const NearMesh& mesh_;
  std::vector<std::uint8_t> blocked_;  ///< vertices at which lines are not as they have to be
  std::vector<Line> lines_;
  std::vector<ChainEdge> edges_;
};

}  // namespace

std::vector<std::uint8_t> Slidable::truly_fixed(std::span<const std::uint8_t> fixed) const {
  std::vector<std::uint8_t> others(fixed.begin(), fixed.end());
  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    if (may_slide(v)) {
      others[static_cast<std::size_t>(vertices[v])] = 0;
    }
  }
  return others;
}

std::vector<std::uint8_t> Slidable::flags_of_elements(std::span<const std::uint8_t> flags) const {
  std::vector<std::uint8_t> found;
  for (const std::int32_t e : element_numbers) {
    found.push_back(flags[e]);
  }
  return found;
}

Slidable find_slidable(const ElementList& elements, std::span<const std::uint8_t> fixed, const Constraints& constraints,
                       Workers& workers) {
  return constraints.slide.along == Slide::off
             ? Slidable{}
             : find_slidable(near_lines(elements, fixed, constraints.regions, workers), constraints.slide);
}

void hold_otherwise(NearLines& near, std::span<const std::int32_t> vertices) {
  std::vector<std::int32_t> sorted(vertices.begin(), vertices.end());
  std::ranges::sort(sorted);
  for (NearElement& element : near.elements) {
    for (std::size_t i = 0; i < element.corners.size(); ++i) {
      if (std::ranges::binary_search(sorted, element.corners[i])) {
        element.reasons[i] |= hold::named;
      }
    }
  }
  near.others.insert(near.others.end(), sorted.begin(), sorted.end());
}

Slidable find_slidable(NearLines near, const Sliding& slide) {
  if (!std::ranges::is_sorted(near.elements, {}, &NearElement::number)) {
    std::ranges::sort(near.elements, {}, &NearElement::number);
  }
  Slidable slidable;
  slidable.along = slide.deviation == 0 ? Slide::straight : slide.along;
  slidable.corner_angle = slide.corner_angle;
  slidable.deviation = slide.deviation;
  slidable.curve = slidable.along == Slide::curves ? slide.curve : SlideCurve::polyline;
  slidable.coincident = slide.coincident;
  const NearMesh mesh(near.elements, near.others);
  const std::vector<std::array<std::int32_t, 2>> neighbours = ChainSearch(mesh, slide).neighbours();
  const auto slides = [&](std::int32_t v) { return neighbours[v][0] != Slidable::none; };
  // The elements around those that slide, and their vertices.
  std::vector<std::uint8_t> is_involved(neighbours.size(), 0);
  for (std::size_t e = 0; e < mesh.size(); ++e) {
    if (std::ranges::any_of(mesh.corners(e), slides)) {
      slidable.element_numbers.push_back(mesh.number(e));
      slidable.elements.push_back(mesh.element(e));
      for (const std::int32_t v : mesh.corners(e)) {
        is_involved[v] = 1;
      }
    }
  }
  if (slidable.elements.empty()) {
    return slidable;
  }
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_free(v)) {
      is_involved[v] = 1;
    }
  }
  std::vector<std::int32_t> places(neighbours.size(), Slidable::none);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (is_involved[v] != 0) {
      places[v] = slidable.vertex_count();
      slidable.vertices.push_back(mesh.number_in_mesh(v));
      slidable.is_free.push_back(mesh.is_free(v) ? 1 : 0);
    }
  }
  // (No corner is none, too.)
  const auto place_of = [&](std::int32_t v) { return v < 0 ? Slidable::none : places[v]; };
  for (std::size_t v = 0; v < neighbours.size(); ++v) {
    if (is_involved[v] != 0) {
      slidable.neighbours.push_back({place_of(neighbours[v][0]), place_of(neighbours[v][1])});
    }
  }
  for (MixedElement& element : slidable.elements) {
    std::ranges::transform(element, element.begin(), place_of);
  }
  for (std::size_t i = 0; i < slide.links.size() / 2; ++i) {
    // (One that is at none of these elements is no vertex that may slide: its partner then is not either.)
    const std::int32_t first = place_of(mesh.vertex(slide.links[2 * i]));
    const std::int32_t second = place_of(mesh.vertex(slide.links[2 * i + 1]));
    if (first != second) {
      slidable.links.push_back({first, second});
    }
  }
  std::vector<std::uint8_t> may_slide;
  for (std::int32_t v = 0; v < slidable.vertex_count(); ++v) {
    may_slide.push_back(slidable.may_slide(v) ? 1 : 0);
  }
  slidable.fans = SlidableFans(slidable.elements, may_slide, slidable.is_free, slidable.vertices);
  return slidable;
}

}  // namespace trismooth
