#include "trismooth/smoothing/slide/slide_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "trismooth/base/splitmix64.h"

namespace trismooth {

namespace {

/// A run of vertices, the ends of an open one included.
struct Run {
  std::vector<std::int32_t> vertices;
  bool is_closed = false;

  /// Places of the vertices that slide.
  std::size_t begin() const { return is_closed ? 0 : 1; }
  std::size_t end() const { return is_closed ? vertices.size() : vertices.size() - 1; }
};

/// Vertices that slide as one, by union-find.
class VertexGroups {
 public:
  explicit VertexGroups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

  std::int32_t of(std::int32_t v) {
    while (parents_[static_cast<std::size_t>(v)] != v) {
      v = parents_[static_cast<std::size_t>(v)] =
          parents_[static_cast<std::size_t>(parents_[static_cast<std::size_t>(v)])];
    }
    return v;
  }
  void join(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax({of(a), of(b)});
    parents_[static_cast<std::size_t>(high)] = low;
  }

 private:
  std::vector<std::int32_t> parents_;
};

class ChainFinder {
 public:
  ChainFinder(const Slidable& slidable, const SlideMesh& mesh)
      : slidable_(slidable),
        mesh_(mesh),
        slides_(slidable.vertices.size()),
        groups_(slidable.vertices.size()),
        run_of_(slidable.vertices.size()) {}

  SlideChains run() {
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      slides_[static_cast<std::size_t>(v)] = slidable_.may_slide(v) && !is_corner(v) ? 1 : 0;
    }
    link();
    do {
      find_runs();
    } while (!match_runs());
    write_chains();
    find_fans();
    order_by_colour();
    return std::move(chains_);
  }

 private:
  Point2<double> point(std::int32_t v) const { return mesh_.points[static_cast<std::size_t>(v)]; }
  double rounding(std::int32_t v) const { return mesh_.roundings[static_cast<std::size_t>(v)]; }
  bool slides(std::int32_t v) const { return slides_[static_cast<std::size_t>(v)] != 0; }
  void hold(std::int32_t v) { slides_[static_cast<std::size_t>(v)] = 0; }
  const std::array<std::int32_t, 2>& neighbours(std::int32_t v) const {
    return slidable_.neighbours[static_cast<std::size_t>(v)];
  }

  /// Whether the chain turns too much.
  bool is_corner(std::int32_t v) const {
    const auto [a, b] = neighbours(v);
    const Point2<double> in = point(v) - point(a);
    const Point2<double> out = point(b) - point(v);
    const double lengths = std::sqrt(squared_length(in)) * std::sqrt(squared_length(out));
    const double forward = in.x * out.x + in.y * out.y;
    if (!(lengths > 0) || forward < std::cos(slidable_.corner_angle * (std::numbers::pi / 180)) * lengths) {
      return true;
    }
    if (slidable_.along == Slide::curves) {
      return false;
    }
    const Point2<double> chord = point(b) - point(a);
    const double off = std::abs(cross(in, chord)) / std::sqrt(squared_length(chord));
    return !(forward > 0 && off <= std::max({rounding(a), rounding(v), rounding(b)}));
  }

  /// Joins what slides as one, and holds what may not slide for what it is joined with.
  void link() {
    for (const auto& [a, b] : slidable_.links) {
      if (a != Slidable::none && b != Slidable::none) {
        groups_.join(a, b);
      } else {
        hold(a != Slidable::none ? a : b);
      }
    }
    std::vector<std::int32_t> held;
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      if (slidable_.is_free[static_cast<std::size_t>(v)] == 0) {
        held.push_back(v);
      }
    }
    std::ranges::sort(held, {}, [&](std::int32_t v) { return std::tuple(point(v).x, point(v).y, v); });
    for (std::size_t i = 1; i < held.size(); ++i) {
      if (point(held[i - 1]) == point(held[i])) {
        if (slidable_.coincident) {
          groups_.join(held[i - 1], held[i]);
        } else {
          hold(held[i - 1]);
          hold(held[i]);
        }
      }
    }
  }

  void find_runs() {
    runs_.clear();
    std::ranges::fill(run_of_, Slidable::none);
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      if (slides(v) && run_of_[static_cast<std::size_t>(v)] == Slidable::none) {
        add_run(v);
      }
    }
  }

  void add_run(std::int32_t v) {
    Run run;
    run.vertices = walk(v, neighbours(v)[0]);
    run.is_closed = run.vertices.back() == v;
    if (run.is_closed) {
      std::ranges::rotate(run.vertices, run.vertices.end() - 1);
    } else {
      std::ranges::reverse(run.vertices);
      run.vertices.push_back(v);
      const std::vector<std::int32_t> on = walk(v, neighbours(v)[1]);
      run.vertices.insert(run.vertices.end(), on.begin(), on.end());
      // So that it is the same from wherever it was found.
      if (run.vertices.front() > run.vertices.back()) {
        std::ranges::reverse(run.vertices);
      }
    }
    for (std::size_t i = run.begin(); i < run.end(); ++i) {
      run_of_[static_cast<std::size_t>(run.vertices[i])] = static_cast<std::int32_t>(runs_.size());
    }
    runs_.push_back(std::move(run));
  }

  /// The vertices from `next` on, away from v, up to one that does not slide or to v itself.
  std::vector<std::int32_t> walk(std::int32_t v, std::int32_t next) const {
    std::vector<std::int32_t> found{next};
    for (std::int32_t last = v; next != v && slides(next);) {
      const auto [a, b] = neighbours(next);
      last = std::exchange(next, a == last ? b : a);
      found.push_back(next);
    }
    return found;
  }

  /// Puts runs together that are linked vertex by vertex. False where some are so in part: their vertices are held
  /// then, and runs are to be found again.
  bool match_runs() {
    std::vector<std::pair<std::int32_t, std::int32_t>> members;  // of groups
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      members.emplace_back(groups_.of(v), v);
    }
    std::ranges::sort(members);
    first_of_run_.assign(runs_.size(), Slidable::none);
    copies_.assign(runs_.size(), {});
    std::vector<std::int32_t> faulty;
    for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end) {
      while (end < members.size() && members[end].first == members[begin].first) {
        ++end;
      }
      const auto group = std::span(members).subspan(begin, end - begin);
      const bool all_slide = std::ranges::all_of(group, [this](const auto& member) { return slides(member.second); });
      if (group.size() > 1 && !all_slide) {
        for (const auto& [number, v] : group) {
          if (slides(v)) {
            faulty.push_back(v);
          }
        }
      }
    }
    for (const Run& run : runs_) {
      add_ends_of_tiny_segments(run, faulty);
    }
    for (std::size_t r = 0; r < runs_.size() && faulty.empty(); ++r) {
      match(static_cast<std::int32_t>(r), members, faulty);
    }
    for (const std::int32_t v : faulty) {
      hold(v);
    }
    return faulty.empty();
  }

  /// Those that slide of vertices at segments so much shorter than their run that places on them would have few digits.
  void add_ends_of_tiny_segments(const Run& run, std::vector<std::int32_t>& found) const {
    const std::size_t segments = run.is_closed ? run.vertices.size() : run.vertices.size() - 1;
    const auto vertex = [&](std::size_t i) { return run.vertices[i % run.vertices.size()]; };
    const auto length = [&](std::size_t i) {
      return std::sqrt(squared_length(point(vertex(i + 1)) - point(vertex(i))));
    };
    double all = 0;
    for (std::size_t i = 0; i < segments; ++i) {
      all += length(i);
    }
    for (std::size_t i = 0; i < segments; ++i) {
      if (!(length(i) > 0x1p-30 * all)) {
        std::ranges::copy_if(std::array{vertex(i), vertex(i + 1)}, std::back_inserter(found),
                             [this](std::int32_t v) { return slides(v); });
      }
    }
  }

  /// The members of a vertex's group, itself first.
  std::vector<std::int32_t> group_of(std::int32_t v, std::span<const std::pair<std::int32_t, std::int32_t>> members) {
    std::vector<std::int32_t> found{v};
    for (const auto& [number, member] :
         std::ranges::equal_range(members, groups_.of(v), {}, [](const auto& pair) { return pair.first; })) {
      if (member != v) {
        found.push_back(member);
      }
    }
    return found;
  }

  /// Finds the copies of a run, turned as it is.
  void match(std::int32_t r, std::span<const std::pair<std::int32_t, std::int32_t>> members,
             std::vector<std::int32_t>& faulty) {
    const Run& run = runs_[static_cast<std::size_t>(r)];
    if (first_of_run_[static_cast<std::size_t>(r)] != Slidable::none) {
      return;
    }
    first_of_run_[static_cast<std::size_t>(r)] = r;
    const std::vector<std::int32_t> first = group_of(run.vertices[run.begin()], members);
    for (std::size_t m = 1; m < first.size(); ++m) {
      const std::int32_t other = run_of_[static_cast<std::size_t>(first[m])];
      Run copy = runs_[static_cast<std::size_t>(other)];
      if (other == r || first_of_run_[static_cast<std::size_t>(other)] != Slidable::none || !turn_alike(run, copy)) {
        faulty.insert(faulty.end(), run.vertices.begin() + static_cast<std::ptrdiff_t>(run.begin()),
                      run.vertices.begin() + static_cast<std::ptrdiff_t>(run.end()));
        return;
      }
      first_of_run_[static_cast<std::size_t>(other)] = r;
      copies_[static_cast<std::size_t>(r)].push_back(std::move(copy));
    }
    for (std::size_t i = run.begin(); i < run.end(); ++i) {
      if (group_of(run.vertices[i], members).size() != first.size()) {
        faulty.push_back(run.vertices[i]);
      }
    }
  }

  /// Turns `copy` so that its vertices are in the groups of those of `run`, one after the other. False: they are not.
  bool turn_alike(const Run& run, Run& copy) {
    if (copy.is_closed != run.is_closed || copy.vertices.size() != run.vertices.size()) {
      return false;
    }
    const auto alike = [&] {
      for (std::size_t i = run.begin(); i < run.end(); ++i) {
        if (groups_.of(run.vertices[i]) != groups_.of(copy.vertices[i])) {
          return false;
        }
      }
      return run.is_closed || (groups_.of(run.vertices.front()) == groups_.of(copy.vertices.front()) ||
                               groups_.of(run.vertices.front()) != groups_.of(copy.vertices.back()));
    };
    for (int direction = 0; direction < 2; ++direction) {
      if (copy.is_closed) {
        const auto start = std::ranges::find_if(
            copy.vertices, [&](std::int32_t v) { return groups_.of(v) == groups_.of(run.vertices.front()); });
        std::rotate(copy.vertices.begin(), start, copy.vertices.end());
      }
      if (alike()) {
        return true;
      }
      std::ranges::reverse(copy.vertices);
    }
    return false;
  }

  void write_chains() {
    chains_.curve = slidable_.curve;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      if (first_of_run_[r] == static_cast<std::int32_t>(r)) {
        write_chain(runs_[r], copies_[r]);
      }
    }
  }

  void write_chain(const Run& run, std::span<const Run> copies) {
    const auto count = static_cast<std::int32_t>(run.vertices.size());
    SlideChain chain{static_cast<std::int32_t>(chains_.knots.size()), count,
                     static_cast<std::int32_t>(copies.size()) + 1, run.is_closed, 0};
    const auto number = static_cast<std::int32_t>(chains_.chains.size());
    add_knots(run);
    for (const Run& copy : copies) {
      add_knots(copy);
    }
    const auto knot = [&](std::int32_t i) { return chains_.knots[static_cast<std::size_t>(chain.first + i % count)]; };
    const auto length = [&](std::int32_t i) { return std::sqrt(squared_length(knot(i + 1) - knot(i))); };
    const std::int32_t segments = run.is_closed ? count : count - 1;
    for (std::int32_t i = 0; i < count; ++i) {
      chains_.arcs.push_back(chain.length);
      const bool has_before = run.is_closed || i > 0;
      const bool has_after = run.is_closed || i < segments;
      const double before = has_before ? length(i > 0 ? i - 1 : count - 1) : length(i);
      const double after = has_after ? length(i) : before;
      const double nearby = std::min(before, after);
      const double allowed = slidable_.along == Slide::curves ? slidable_.deviation * nearby : 0;
      const double rounded = rounding_around(run, copies, static_cast<std::size_t>(i));
      chains_.lengths.push_back(nearby);
      chains_.limits.push_back(std::max(allowed - rounded, 2 * rounded));
      chains_.allowed.push_back(std::max(allowed, 3 * rounded));
      chains_.places.push_back({chain.length, run.is_closed || i < segments ? i : i - 1});
      chain.length += i < segments ? after : 0;
      if (run.is_closed || (i > 0 && i < segments)) {
        chains_.sliders.push_back({number, chain.first + i, 0});
      }
    }
    chains_.arcs.resize(chains_.knots.size());
    chains_.lengths.resize(chains_.knots.size());
    chains_.limits.resize(chains_.knots.size());
    chains_.allowed.resize(chains_.knots.size());
    chains_.places.resize(chains_.knots.size());
    chains_.chains.push_back(chain);
  }

  /// How far rounding may have brought a vertex of a run, those next to it, and those of the copies.
  double rounding_around(const Run& run, std::span<const Run> copies, std::size_t i) const {
    double largest = 0;
    const auto look = [&](const Run& of) {
      const std::size_t count = of.vertices.size();
      const std::size_t before = i > 0 ? i - 1 : (of.is_closed ? count - 1 : i);
      const std::size_t after = i + 1 < count ? i + 1 : (of.is_closed ? 0 : i);
      for (const std::size_t place : {before, i, after}) {
        largest = std::max(largest, rounding(of.vertices[place]));
      }
    };
    look(run);
    std::ranges::for_each(copies, look);
    return largest;
  }

  /// With the vertices' numbers here, which are replaced at the end.
  void add_knots(const Run& run) {
    for (const std::int32_t v : run.vertices) {
      chains_.knots.push_back(point(v));
      chains_.vertices.push_back(v);
    }
  }

  /// The triangles around each slider.
  void find_fans() {
    std::vector<std::pair<std::int32_t, std::int32_t>> around;  // (vertex, triangle)
    for (std::size_t t = 0; t < slidable_.triangles.size(); ++t) {
      for (const std::int32_t v : slidable_.triangles[t]) {
        if (slides(v)) {
          around.emplace_back(v, static_cast<std::int32_t>(t));
        }
      }
    }
    std::ranges::sort(around);
    const std::vector<std::uint8_t> is_unknown = vertices_without_free_neighbour();
    std::int32_t fan = 0;
    for (Slider& slider : chains_.sliders) {
      const SlideChain& chain = chains_.chains[static_cast<std::size_t>(slider.chain)];
      slider.fan = fan;
      for (std::int32_t copy = 0; copy < chain.copies; ++copy, ++fan) {
        const std::int32_t v = chains_.vertices[static_cast<std::size_t>(slider.knot + copy * chain.count)];
        const auto begin = std::ssize(chains_.sides);
        for (const auto& [vertex, t] :
             std::ranges::equal_range(around, v, {}, [](const auto& pair) { return pair.first; })) {
          chains_.sides.push_back(side_of(v, t, is_unknown));
        }
        // Sums are the same in whatever order the triangles are listed.
        std::sort(chains_.sides.begin() + begin, chains_.sides.end(),
                  [](const FanSide& a, const FanSide& b) { return a.from < b.from; });
        for (auto side = chains_.sides.begin() + begin; side != chains_.sides.end(); ++side) {
          side->from = number(side->from);
          side->to = number(side->to);
        }
        chains_.fans.push_back(static_cast<std::int32_t>(chains_.sides.size()));
      }
    }
    for (std::size_t t = 0; t < slidable_.triangles.size(); ++t) {
      const Triangle& triangle = slidable_.triangles[t];
      const auto is_free = [&](std::int32_t v) { return slidable_.is_free[static_cast<std::size_t>(v)] != 0; };
      if (std::ranges::none_of(triangle, is_free) &&
          std::ranges::any_of(triangle, [this](std::int32_t v) { return slidable_.may_slide(v); })) {
        Triangle corners = canonical_corners(triangle, is_reversed(t));
        for (std::int32_t& v : corners) {
          v = number(v);
        }
        chains_.held_triangles.push_back(corners);
      }
    }
  }

  std::int32_t number(std::int32_t v) const { return mesh_.numbers[static_cast<std::size_t>(v)]; }
  bool is_reversed(std::size_t t) const { return mesh_.reversed[t] != 0; }

  std::vector<std::uint8_t> vertices_without_free_neighbour() const {
    std::vector<std::uint8_t> is_unknown(slidable_.vertices.size(), 1);
    for (const Triangle& triangle : slidable_.triangles) {
      if (std::ranges::any_of(triangle,
                              [&](std::int32_t v) { return slidable_.is_free[static_cast<std::size_t>(v)] != 0; })) {
        for (const std::int32_t v : triangle) {
          is_unknown[static_cast<std::size_t>(v)] = 0;
        }
      }
    }
    return is_unknown;
  }

  /// With the numbers that vertices have here.
  FanSide side_of(std::int32_t v, std::int32_t t, std::span<const std::uint8_t> is_unknown) const {
    Triangle triangle =
        canonical_corners(slidable_.triangles[static_cast<std::size_t>(t)], is_reversed(static_cast<std::size_t>(t)));
    std::rotate(triangle.begin(), std::ranges::find(triangle, v), triangle.end());
    const auto [self, from, to] = triangle;
    return {from, to, is_unknown[static_cast<std::size_t>(from)] != 0, is_unknown[static_cast<std::size_t>(to)] != 0};
  }

  /// Colours sliders that share an edge, through any of their copies, differently: greedily, in the order of
  /// splitmix64(number in the mesh) of the first copy.
  void order_by_colour() {
    // Which slider a vertex belongs to.
    std::vector<std::int32_t> slider_of(slidable_.vertices.size(), Slidable::none);
    for (std::size_t s = 0; s < chains_.sliders.size(); ++s) {
      for_vertices_of(chains_.sliders[s],
                      [&](std::int32_t v) { slider_of[static_cast<std::size_t>(v)] = static_cast<std::int32_t>(s); });
    }
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    for (const Triangle& triangle : slidable_.triangles) {
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = slider_of[static_cast<std::size_t>(triangle[static_cast<std::size_t>(i)])];
        const std::int32_t b = slider_of[static_cast<std::size_t>(triangle[static_cast<std::size_t>((i + 1) % 3)])];
        if (a != Slidable::none && b != Slidable::none && a != b) {
          edges.emplace_back(a, b);
          edges.emplace_back(b, a);
        }
      }
    }
    std::ranges::sort(edges);
    std::vector<std::int32_t> order(chains_.sliders.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(
        order, [&](std::int32_t a, std::int32_t b) { return coloured_before(input_number(a), input_number(b)); });
    std::vector<std::int32_t> colours(order.size(), Slidable::none);
    std::int32_t count = 0;
    for (const std::int32_t s : order) {
      std::vector<std::uint8_t> taken(static_cast<std::size_t>(count) + 1, 0);
      for (const auto& [self, other] :
           std::ranges::equal_range(edges, s, {}, [](const auto& pair) { return pair.first; })) {
        if (const std::int32_t colour = colours[static_cast<std::size_t>(other)]; colour != Slidable::none) {
          taken[static_cast<std::size_t>(colour)] = 1;
        }
      }
      const auto colour = static_cast<std::int32_t>(std::ranges::find(taken, 0) - taken.begin());
      colours[static_cast<std::size_t>(s)] = colour;
      count = std::max(count, colour + 1);
    }
    std::vector<Slider> sorted;
    for (std::int32_t colour = 0; colour < count; ++colour) {
      for (std::size_t s = 0; s < colours.size(); ++s) {
        if (colours[s] == colour) {
          sorted.push_back(chains_.sliders[s]);
        }
      }
      chains_.batches.push_back(static_cast<std::int32_t>(sorted.size()));
    }
    chains_.sliders = std::move(sorted);
    for (std::int32_t& v : chains_.vertices) {
      v = number(v);
    }
  }

  std::int32_t input_number(std::int32_t slider) const {
    const std::int32_t v =
        chains_.vertices[static_cast<std::size_t>(chains_.sliders[static_cast<std::size_t>(slider)].knot)];
    return slidable_.vertices[static_cast<std::size_t>(v)];
  }

  template <class Visit>
  void for_vertices_of(const Slider& slider, const Visit& visit) const {
    const SlideChain& chain = chains_.chains[static_cast<std::size_t>(slider.chain)];
    for (std::int32_t copy = 0; copy < chain.copies; ++copy) {
      visit(chains_.vertices[static_cast<std::size_t>(slider.knot + copy * chain.count)]);
    }
  }

  const Slidable& slidable_;
  const SlideMesh& mesh_;
  std::vector<std::uint8_t> slides_;
  VertexGroups groups_;
  std::vector<Run> runs_;
  std::vector<std::int32_t> run_of_;        ///< of each vertex that slides
  std::vector<std::int32_t> first_of_run_;  ///< the run that each is a copy of, maybe itself
  std::vector<std::vector<Run>> copies_;    ///< of each run that is no copy
  SlideChains chains_;
};

}  // namespace

std::int64_t SlideChains::vertex_count() const {
  std::int64_t count = 0;
  for (const Slider& slider : sliders) {
    count += chains[static_cast<std::size_t>(slider.chain)].copies;
  }
  return count;
}

HeldNeighbours SlideChains::neighbours(std::int32_t first, std::int32_t end) const {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const Slider& slider : sliders) {
    const SlideChain& chain = chains[static_cast<std::size_t>(slider.chain)];
    for (std::int32_t copy = 0; copy < chain.copies; ++copy) {
      const std::int32_t v = vertices[static_cast<std::size_t>(slider.knot + copy * chain.count)];
      const auto fan = static_cast<std::size_t>(slider.fan + copy);
      for (std::int32_t i = fans[fan]; i < fans[fan + 1]; ++i) {
        const FanSide& side = sides[static_cast<std::size_t>(i)];
        pairs.emplace_back(v, side.from);
        pairs.emplace_back(v, side.to);
      }
    }
  }
  return {first, end, pairs};
}

SlideChains find_slide_chains(const Slidable& slidable, const SlideMesh& mesh) {
  return ChainFinder(slidable, mesh).run();
}

}  // namespace trismooth
