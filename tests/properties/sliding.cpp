// SPDX-License-Identifier: BSD-3-Clause
// What users are promised of vertices that slide, judged from the coordinates alone: who may, where to, how far the
// lines are from what they were, and that nothing gets worse. Shares no code with what it judges.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

namespace sliding_test {

using namespace properties;
using trismooth::Evaluation;
using trismooth::Slide;
using trismooth::SlideCurve;
using trismooth::Triangle;

using Number = long double;
using Spot = Point2<Number>;

Spot at(std::span<const double> xy, std::int32_t v) {
  return {xy[2 * v], xy[2 * v + 1]};
}
Number length(Spot a, Spot b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}
Number distance_to_edge(Spot p, Spot a, Spot b) {
  const Spot way{b.x - a.x, b.y - a.y};
  const Number squared = way.x * way.x + way.y * way.y;
  const Number part = squared > 0 ? std::clamp<Number>(((p.x - a.x) * way.x + (p.y - a.y) * way.y) / squared, 0, 1) : 0;
  return length(p, {a.x + part * way.x, a.y + part * way.y});
}

/// An edge of a boundary or between two regions.
struct LineEdge {
  std::int32_t a, b;
  std::pair<std::int32_t, std::int32_t> regions;  ///< on its sides; the same twice on a boundary...
  bool is_boundary;                               ///< ...which this says
};

std::vector<LineEdge> line_edges(const RandomMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> around;
  std::map<std::pair<std::int32_t, std::int32_t>, std::set<std::int32_t>> apexes;
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::pair<std::int32_t, std::int32_t> edge = std::minmax({corners[i], corners[(i + 1) % 3]});
      around[edge].push_back(mesh.regions.empty() ? 0 : mesh.regions[t]);
      apexes[edge].insert(corners[(i + 2) % 3]);
    }
  }
  std::vector<LineEdge> edges;
  for (const auto& [ends, regions] : around) {
    if (regions.size() != 2 || regions[0] != regions[1] || apexes[ends].size() < 2) {
      edges.push_back({ends.first, ends.second, std::minmax({regions.front(), regions.back()}), regions.size() == 1});
    }
    // An edge of many triangles, or of copies of one, is on no single line.
    if (regions.size() > 2 || (regions.size() == 2 && apexes[ends].size() < 2)) {
      edges.push_back(edges.back());
    }
  }
  return edges;
}

/// The lines of a mesh, and who may slide on them.
struct Lines {
  std::vector<LineEdge> edges;
  std::vector<std::vector<std::size_t>> at;  ///< edges at each vertex
  std::vector<bool> may_slide;
};

Lines lines_of(const RandomMesh& mesh) {
  Lines lines{line_edges(mesh), {}, {}};
  const std::vector<double> xy = mesh.mesh.xy();
  lines.at.resize(mesh.mesh.points.size());
  lines.may_slide.resize(mesh.mesh.points.size());
  for (std::size_t e = 0; e < lines.edges.size(); ++e) {
    lines.at[lines.edges[e].a].push_back(e);
    lines.at[lines.edges[e].b].push_back(e);
  }
  // Held by what is no line, too: they may not.
  const Connectivity all = connectivity_of(mesh);
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    const std::vector<std::size_t>& here = lines.at[v];
    const bool is_named = (!mesh.fixed.empty() && mesh.fixed[v] != 0) ||
                          (!mesh.other_cells.empty() && mesh.other_cells[v] != 0) ||
                          std::ranges::count(mesh.fixed_ids, v) > 0;
    if (here.size() != 2 || is_named || !all.fixed[v]) {
      continue;
    }
    const LineEdge& first = lines.edges[here[0]];
    const LineEdge& second = lines.edges[here[1]];
    if (first.regions != second.regions || first.is_boundary != second.is_boundary) {
      continue;
    }
    const Spot before = at(xy, first.a == v ? first.b : first.a);
    const Spot after = at(xy, second.a == v ? second.b : second.a);
    const Spot here_is = at(xy, v);
    const Number turn =
        std::atan2((here_is.x - before.x) * (after.y - here_is.y) - (here_is.y - before.y) * (after.x - here_is.x),
                   (here_is.x - before.x) * (after.x - here_is.x) + (here_is.y - before.y) * (after.y - here_is.y));
    constexpr Number rounding = 1e-9;
    lines.may_slide[v] =
        std::abs(turn) * 180 / std::numbers::pi_v<Number> <= static_cast<Number>(mesh.slide.corner_angle) + rounding;
  }
  return lines;
}

/// How far a stored coordinate may be from where it was meant to be.
Number rounding_of(std::span<const double> xy) {
  Number farthest = 0;
  for (const double x : xy) {
    farthest = std::max<Number>(farthest, std::abs(x));
  }
  constexpr Number of_smallest = std::numeric_limits<double>::denorm_min();
  return 16 * std::max(std::numeric_limits<double>::epsilon() * farthest, of_smallest);
}

Number distance_to_lines(Spot p, std::span<const LineEdge> edges, std::span<const double> xy) {
  Number nearest = std::numeric_limits<Number>::infinity();
  for (const LineEdge& edge : edges) {
    nearest = std::min(nearest, distance_to_edge(p, at(xy, edge.a), at(xy, edge.b)));
  }
  return nearest;
}

bool has_moved(const RandomMesh& mesh, const Run& run, std::int32_t v) {
  return run.xy[2 * v] != mesh.mesh.points[v].x || run.xy[2 * v + 1] != mesh.mesh.points[v].y;
}

/// What is wrong with the lines of a result.
std::string breach_of_lines(const RandomMesh& mesh, const Lines& lines, const Run& run) {
  const std::vector<double> before = mesh.mesh.xy();
  const Number rounding = rounding_of(before);
  const auto deviation = static_cast<Number>(mesh.slide.along == Slide::curves ? mesh.slide.deviation : 0);
  Number largest = 0;
  Number shortest_of_all = std::numeric_limits<Number>::infinity();
  std::int64_t slid = 0;
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (lines.at[v].empty()) {
      continue;
    }
    Number shortest = std::numeric_limits<Number>::infinity();
    for (const std::size_t e : lines.at[v]) {
      shortest = std::min(shortest, length(at(before, lines.edges[e].a), at(before, lines.edges[e].b)));
    }
    shortest_of_all = std::min(shortest_of_all, shortest);
    const Number off = distance_to_lines(at(before, v), lines.edges, run.xy);
    largest = std::max(largest, off);
    if (off > deviation * shortest + rounding) {
      return fmt::format("the line has left vertex {} by {}, {} of the shorter edge there", v, static_cast<double>(off),
                         static_cast<double>(off / shortest));
    }
    if (!has_moved(mesh, run, v)) {
      continue;
    }
    ++slid;
    const Number beside = distance_to_lines(at(run.xy, v), lines.edges, before);
    largest = std::max(largest, beside);
    if (mesh.slide.curve == SlideCurve::polyline && beside > rounding) {
      return fmt::format("vertex {} is {} beside the line", v, static_cast<double>(beside));
    }
  }
  const trismooth::SlidingResult& told = *run.result.sliding;
  if (told.slid != slid) {
    return fmt::format("{} vertices have slid, not {}", slid, told.slid);
  }
  if (static_cast<Number>(told.largest_deviation) < largest - rounding) {
    return fmt::format("the lines are {} apart, not {}", static_cast<double>(largest), told.largest_deviation);
  }
  if (static_cast<Number>(told.relative_deviation) > deviation * (1 + 1e-9L) + rounding / shortest_of_all) {
    return fmt::format("it says that lines are {} of an edge apart", told.relative_deviation);
  }
  return {};
}

/// Calls check(mesh, options, random) for some ways to slide.
template <class Check>
std::string for_some_slides(const RandomMesh& mesh, std::uint64_t count, const Check& check) {
  return for_some_options(mesh, count, [&](SmoothingOptions options, test_meshes::Random& random) {
    RandomMesh sliding = mesh;
    sliding.slide = any_sliding(random);
    options.untangle = trismooth::Untangle::off;
    const std::string wrong = check(sliding, options, random);
    return wrong.empty()
               ? wrong
               : fmt::format("{} (slides {}, corner angle {}, deviation {}, {})", wrong, to_string(sliding.slide.along),
                             sliding.slide.corner_angle, sliding.slide.deviation, to_string(sliding.slide.curve));
  });
}

TEST_CASE("only vertices of one line slide, on it and no further from it than they may, and nothing gets worse") {
  std::int64_t slid = 0;
  for_random_meshes(4000, [&](const RandomMesh& mesh) {
    return for_some_slides(mesh, 3, [&](const RandomMesh& sliding, const SmoothingOptions& options, auto& /*random*/) {
      Run found = run(sliding, options);
      if (!found.result.sliding) {
        return std::string();
      }
      slid += found.result.sliding->slid;
      const Lines lines = lines_of(sliding);
      Connectivity connectivity = connectivity_of(sliding);
      for (std::size_t v = 0; v < lines.may_slide.size(); ++v) {
        if (lines.may_slide[v]) {
          connectivity.fixed[v] = false;
          ++found.result.free_vertices;
        }
      }
      const std::string wrong = breach(sliding, connectivity, found, options.guard);
      return !wrong.empty() ? wrong : breach_of_lines(sliding, lines, found);
    });
  });
  CHECK(slid > meshes_of(4000));
}

TEST_CASE("sliding gives the same bits again, by plans, evaluating all, and in whatever order triangles are listed") {
  for_random_meshes(1500, [](const RandomMesh& mesh) {
    const bool is_tied = connectivity_of(mesh).is_tied_anywhere;
    return for_some_slides(
        mesh, 2, [&](const RandomMesh& sliding, SmoothingOptions options, test_meshes::Random& random) -> std::string {
          const Run expected = run(sliding, options);
          auto plan =
              trismooth::plan(sliding.mesh.vertex_count(), sliding.mesh.indices(), sliding.constraints(), options);
          for (int times = 0; times < 2; ++times) {
            Run planned{sliding.mesh.xy(), {}};
            planned.result = plan.smooth(planned.xy);
            if (const std::string wrong = difference(planned, expected); !wrong.empty()) {
              return "a plan: " + wrong;
            }
          }
          RandomMesh turned = sliding;
          for (Triangle& t : turned.mesh.triangles) {
            std::rotate(t.begin(), t.begin() + random.below(3), t.end());
            if (random.below(2) == 0 && !is_tied) {
              std::swap(t[0], t[1]);
            }
          }
          if (const std::string wrong = difference(run(turned, options), expected); !wrong.empty()) {
            return "triangles listed otherwise: " + wrong;
          }
          options.evaluation = Evaluation::all;
          const std::string wrong = difference(run(sliding, options), expected);
          return wrong.empty() ? wrong : "evaluating all: " + wrong;
        });
  });
}

}  // namespace sliding_test
