#include "trismooth/smoothing/rings/slidable.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

/// Whether nothing but a chain holds it.
bool is_held_by_chains(std::uint8_t reasons) {
  constexpr std::uint8_t of_chains = hold::boundary | hold::interface | hold::line;
  return reasons != 0 && (reasons & ~of_chains) == 0;
}

/// What an edge is a part of: chains end where this changes.
struct ChainKind {
  std::int32_t low_region = 0;
  std::int32_t high_region = 0;
  bool is_boundary = false;
  bool is_line = false;
  std::int32_t tag = 0;

  bool operator==(const ChainKind&) const = default;
};

/// A vertex and another one on an edge of a chain.
struct ChainEnd {
  std::int32_t vertex;
  std::int32_t other;
  ChainKind kind;
};

struct EdgeSide {
  std::int32_t low, high, triangle;
  auto operator<=>(const EdgeSide&) const = default;
};

struct Line {
  std::int32_t low, high, tag;
  auto operator<=>(const Line&) const = default;
};

std::vector<Line> sorted_lines(const Sliding& slide) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < slide.lines.size() / 2; ++i) {
    const auto [low, high] = std::minmax(slide.lines[2 * i], slide.lines[2 * i + 1]);
    lines.push_back({low, high, slide.line_tags.empty() ? 0 : slide.line_tags[i]});
  }
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

/// Finds the chains' edges at the vertices that nothing else holds.
class ChainSearch {
 public:
  ChainSearch(std::span<const Triangle> triangles, std::span<const std::uint8_t> fixed, const Constraints& constraints)
      : triangles_(triangles), fixed_(fixed), regions_(constraints.regions), lines_(sorted_lines(constraints.slide)) {}

  /// `near`: the triangles with such a vertex. Returns pairs (vertex, neighbours) of those that may slide, ascending.
  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 2>>> run(std::span<const std::int32_t> near) {
    find_edges(near);
    return find_vertices();
  }

 private:
  bool is_candidate(std::int32_t v) const { return is_held_by_chains(fixed_[static_cast<std::size_t>(v)]); }

  void find_edges(std::span<const std::int32_t> near) {
    std::vector<EdgeSide> sides;
    for (const std::int32_t t : near) {
      const auto& [a, b, c] = triangles_[static_cast<std::size_t>(t)];
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
        const bool is_held = fixed_[static_cast<std::size_t>(from)] != 0 && fixed_[static_cast<std::size_t>(to)] != 0;
        if (is_held && (is_candidate(from) || is_candidate(to))) {
          sides.push_back({std::min(from, to), std::max(from, to), t});
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
      // Lines beside the edges: what they are on is no edge of these triangles.
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

  void block(const Line& line) {
    blocked_.push_back(line.low);
    blocked_.push_back(line.high);
  }

  /// `sides`: all of one edge.
  void add_edge(std::span<const EdgeSide> sides, const Line* line) {
    const auto region = [this](const EdgeSide& side) {
      return regions_.empty() ? 0 : regions_[static_cast<std::size_t>(side.triangle)];
    };
    const auto [low, high] = std::minmax({region(sides.front()), region(sides.back())});
    const bool is_boundary = sides.size() == 1;
    if (sides.size() > 2 || (!is_boundary && low == high && line == nullptr)) {
      return;
    }
    const ChainKind kind{low, high, is_boundary, line != nullptr, line != nullptr ? line->tag : 0};
    const auto& [a, b, triangle] = sides.front();
    ends_.push_back({a, b, kind});
    ends_.push_back({b, a, kind});
  }

  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 2>>> find_vertices() {
    std::ranges::sort(ends_, {}, [](const ChainEnd& end) { return std::pair(end.vertex, end.other); });
    std::ranges::sort(blocked_);
    std::vector<std::pair<std::int32_t, std::array<std::int32_t, 2>>> found;
    for (std::size_t begin = 0, end = 0; begin < ends_.size(); begin = end) {
      const std::int32_t v = ends_[begin].vertex;
      while (end < ends_.size() && ends_[end].vertex == v) {
        ++end;
      }
      if (end - begin == 2 && is_candidate(v) && ends_[begin].kind == ends_[begin + 1].kind &&
          !std::ranges::binary_search(blocked_, v)) {
        found.push_back({v, {ends_[begin].other, ends_[begin + 1].other}});
      }
    }
    return found;
  }

  std::span<const Triangle> triangles_;
  std::span<const std::uint8_t> fixed_;
  std::span<const std::int32_t> regions_;
  std::vector<Line> lines_;
  std::vector<ChainEnd> ends_;
  std::vector<std::int32_t> blocked_;  ///< vertices at which lines are not as they have to be
};

std::int32_t place_of(std::span<const std::int32_t> sorted, std::int32_t number) {
  return static_cast<std::int32_t>(std::ranges::lower_bound(sorted, number) - sorted.begin());
}

bool holds(std::span<const std::int32_t> sorted, std::int32_t number) {
  return std::ranges::binary_search(sorted, number);
}

}  // namespace

std::vector<std::uint8_t> Slidable::truly_fixed(std::span<const std::uint8_t> fixed) const {
  std::vector<std::uint8_t> others(fixed.begin(), fixed.end());
  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    if (may_slide(v)) {
      others[static_cast<std::size_t>(vertices[static_cast<std::size_t>(v)])] = 0;
    }
  }
  return others;
}

Slidable find_slidable(std::span<const Triangle> triangles, std::span<const std::uint8_t> fixed,
                       const Constraints& constraints, Workers& workers) {
  Slidable slidable;
  const Sliding& slide = constraints.slide;
  if (slide.along == Slide::off) {
    return slidable;
  }
  const auto has_vertex = [&](std::int64_t t, const auto& is_one) {
    return std::ranges::any_of(triangles[static_cast<std::size_t>(t)], is_one);
  };
  const BulkVector<std::int32_t> near = numbers_of(
      std::ssize(triangles),
      [&](std::int64_t t) {
        return has_vertex(t, [&](std::int32_t v) { return is_held_by_chains(fixed[static_cast<std::size_t>(v)]); });
      },
      workers);
  const auto sliding = ChainSearch(triangles, fixed, constraints).run(near);
  std::vector<std::int32_t> movable;
  std::ranges::transform(sliding, std::back_inserter(movable), [](const auto& found) { return found.first; });
  for (const std::int32_t t : near) {
    if (has_vertex(t, [&](std::int32_t v) { return holds(movable, v); })) {
      slidable.triangle_numbers.push_back(t);
      std::ranges::copy(triangles[static_cast<std::size_t>(t)], std::back_inserter(slidable.vertices));
    }
  }
  std::ranges::sort(slidable.vertices);
  slidable.vertices.erase(std::unique(slidable.vertices.begin(), slidable.vertices.end()), slidable.vertices.end());
  const std::span<const std::int32_t> vertices = slidable.vertices;
  slidable.neighbours.assign(vertices.size(), {Slidable::none, Slidable::none});
  for (const auto& [v, others] : sliding) {
    slidable.neighbours[static_cast<std::size_t>(place_of(vertices, v))] = {place_of(vertices, others[0]),
                                                                            place_of(vertices, others[1])};
  }
  for (const std::int32_t v : vertices) {
    slidable.is_free.push_back(fixed[static_cast<std::size_t>(v)] == 0 ? 1 : 0);
  }
  for (const std::int32_t t : slidable.triangle_numbers) {
    const auto& [a, b, c] = triangles[static_cast<std::size_t>(t)];
    slidable.triangles.push_back({place_of(vertices, a), place_of(vertices, b), place_of(vertices, c)});
  }
  for (std::size_t i = 0; i < slide.links.size() / 2; ++i) {
    // (One that is at none of these triangles is no vertex that may slide: its partner then is not either.)
    const std::int32_t a = slide.links[2 * i];
    const std::int32_t b = slide.links[2 * i + 1];
    const std::int32_t first = holds(vertices, a) ? place_of(vertices, a) : Slidable::none;
    const std::int32_t second = holds(vertices, b) ? place_of(vertices, b) : Slidable::none;
    if (a != b && (first != Slidable::none || second != Slidable::none)) {
      slidable.links.push_back({first, second});
    }
  }
  slidable.along = slide.deviation == 0 ? Slide::straight : slide.along;
  slidable.corner_angle = slide.corner_angle;
  slidable.deviation = slide.deviation;
  slidable.curve = slidable.along == Slide::curves ? slide.curve : SlideCurve::polyline;
  slidable.coincident = slide.coincident;
  return slidable;
}

}  // namespace trismooth
