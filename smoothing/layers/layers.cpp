// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/layers/layers.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "trismooth/base/edge_matching.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/machine/blocks.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/parity_forest.h"
#include "trismooth/quality/corner_points.h"

namespace trismooth {

namespace {

constexpr std::int64_t triangle_grain = 16384;

/// The flat triangles of the view, ascending.
std::vector<ListedFlat> list_flat(const TriangleView& view, Workers& workers) {
  const Blocks blocks(std::ssize(view.elements), triangle_grain, workers);
  std::vector<std::vector<ListedFlat>> found(static_cast<std::size_t>(blocks.count()));
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::vector<ListedFlat>& own = found[block];
    for_corners(view, static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
                [&own](std::size_t first, std::span<const CornerPoints> corners) {
                  for (std::size_t i = 0; i < corners.size(); ++i) {
                    const auto& [a, b, c] = corners[i];
                    if (is_flat(a, b, c)) {
                      own.push_back({static_cast<std::int32_t>(first + i), in_units(flat_tensor(a, b, c))});
                    }
                  }
                });
  });
  std::vector<ListedFlat> all = std::move(found.front());
  for (std::size_t b = 1; b < found.size(); ++b) {
    all.insert(all.end(), found[b].begin(), found[b].end());
  }
  return all;
}

/// Sorts them, each once.
void make_set(std::vector<std::int32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// One connected stretch of flat triangles, as far as has been counted.
struct Stretch {
  std::int64_t triangles = 0;
  std::int64_t moderate = 0;
  std::int64_t obtuse = 0;
  std::int64_t inside = 0;   ///< vertices all around which it goes
  std::int64_t in_fans = 0;  ///< triangles at a vertex with more than 6 flat ones
  double smallest_quotient = 1;

  void add(const FlatTriangle& flat) {
    ++triangles;
    moderate += flat.angle == FlatTriangle::Angle::moderate ? 1 : 0;
    obtuse += flat.angle == FlatTriangle::Angle::obtuse ? 1 : 0;
    smallest_quotient = std::min(smallest_quotient, flat.quotient);
  }
  bool is_clean() const { return 2 * moderate > triangles && 10 * obtuse < triangles; }
  /// Whether it is told of: where it is wide, or a band of even width. Chains of slivers along the hull of random
  /// points are neither: they run from fan to fan.
  bool is_wide() const { return 8 * inside >= triangles; }
  bool is_band() const { return 20 * in_fans < triangles; }
};

/// The corners of candidates. Where these are few, in numbers of their own, and `vertex_count` becomes theirs: what is
/// counted at vertices costs no more than the candidates then.
std::vector<Triangle> corners_of(std::span<const FlatTriangle> candidates, std::int32_t& vertex_count) {
  std::vector<Triangle> triangles(candidates.size());
  std::ranges::transform(candidates, triangles.begin(), &FlatTriangle::corners);
  if (8 * std::ssize(triangles) < vertex_count) {
    std::vector<std::int32_t> used;
    for (const Triangle& corners : triangles) {
      used.insert(used.end(), corners.begin(), corners.end());
    }
    make_set(used);
    for (Triangle& corners : triangles) {
      for (std::int32_t& v : corners) {
        v = static_cast<std::int32_t>(std::ranges::lower_bound(used, v) - used.begin());
      }
    }
    vertex_count = static_cast<std::int32_t>(used.size());
  }
  return triangles;
}

/// Which stretch each candidate is in, by the number of its first one.
class Stretches {
 public:
  Stretches(std::span<const FlatTriangle> candidates, std::int32_t vertex_count, std::int64_t least, Workers& workers)
      : candidates_(candidates),
        triangles_(corners_of(candidates, vertex_count)),
        least_(least),
        roots_(candidates.size()),
        stretches_(candidates.size()) {
    join(vertex_count, workers);
    for (std::size_t t = 0; t < candidates_.size(); ++t) {
      stretches_[roots_[t]].add(candidates_[t]);
    }
    look_around(vertex_count);
  }

  const Stretch& of(std::size_t triangle) const { return stretches_[roots_[triangle]]; }
  bool counts(const Stretch& stretch) const { return stretch.triangles >= least_; }
  /// Whether the stretch of the triangle goes all around a corner of it.
  bool goes_around(std::size_t triangle, int corner) const {
    return excess_[static_cast<std::size_t>(triangles_[triangle][corner])] == 0;
  }

 private:
  void join(std::int32_t vertex_count, Workers& workers) {
    std::vector<std::int32_t> corner(static_cast<std::size_t>(vertex_count), -1);
    for (std::size_t t = triangles_.size(); t-- > 0;) {
      for (int i = 2; i >= 0; --i) {
        corner[triangles_[t][i]] = static_cast<std::int32_t>(3 * t) + i;
      }
    }
    std::vector<std::int32_t> twins(3 * triangles_.size());
    match_edges(triangles_, corner, twins, workers);
    std::vector<std::uint32_t> words(triangles_.size());
    const ParityForest forest{words.data()};
    for (std::uint32_t t = 0; t < words.size(); ++t) {
      forest.plant(t);
    }
    for (std::size_t h = 0; h < twins.size(); ++h) {
      const std::int32_t twin = twins[h];
      if (twin >= 0 && static_cast<std::size_t>(twin) > h &&
          are_coherent(candidates_[h / 3], candidates_[static_cast<std::size_t>(twin) / 3])) {
        forest.join(static_cast<std::uint32_t>(h / 3), static_cast<std::uint32_t>(twin / 3), 0);
        sides_.push_back(static_cast<std::int32_t>(h));
      }
    }
    for (std::uint32_t t = 0; t < words.size(); ++t) {
      roots_[t] = forest.find(t).element;
    }
  }

  /// A stretch goes all around a vertex where it has as many sides as triangles there.
  void look_around(std::int32_t vertex_count) {
    excess_.assign(static_cast<std::size_t>(vertex_count), 0);
    std::vector<std::int32_t> some(static_cast<std::size_t>(vertex_count), -1);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (const std::int32_t v : triangles_[t]) {
        ++excess_[v];
        some[v] = static_cast<std::int32_t>(roots_[t]);
      }
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto is_in_fan = [this](std::int32_t v) { return excess_[v] > 6; };
      stretches_[roots_[t]].in_fans += std::ranges::any_of(triangles_[t], is_in_fan) ? 1 : 0;
    }
    for (const std::int32_t h : sides_) {
      const Triangle& corners = triangles_[static_cast<std::size_t>(h / 3)];
      --excess_[static_cast<std::size_t>(corners[h % 3])];
      --excess_[static_cast<std::size_t>(corners[(h + 1) % 3])];
    }
    for (std::size_t v = 0; v < excess_.size(); ++v) {
      if (some[v] >= 0 && excess_[v] == 0) {
        ++stretches_[some[v]].inside;
      }
    }
  }

  std::span<const FlatTriangle> candidates_;
  std::vector<Triangle> triangles_;  ///< their corners
  std::int64_t least_;
  std::vector<std::uint32_t> roots_;
  std::vector<Stretch> stretches_;    ///< one a candidate; of those that are no root nothing is counted
  std::vector<std::int32_t> sides_;   ///< between coherent candidates, by the halfedge of the first
  std::vector<std::int32_t> excess_;  ///< per vertex: its triangles less the sides between coherent ones
};

}  // namespace

LayerCandidates::LayerCandidates(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                                 std::span<const std::uint8_t> reversed, Workers& workers,
                                 const std::function<void(std::span<FlatAround>)>& complete)
    : view_{points, triangles, reversed} {
  left_[0] = list_flat(view_, workers);
  for (std::size_t choice = 1; choice < left_.size(); ++choice) {
    std::vector<ListedFlat> left = left_[choice - 1];
    if (!complete && std::ssize(left) < layers_least_seen) {
      return;
    }
    BulkVector<FlatAround> around(points.size());
    std::ranges::fill(around, FlatAround{});
    workers.for_blocks(std::ssize(left), triangle_grain, [&](std::int64_t begin, std::int64_t end) {
      const auto add = [](std::uint32_t& sum, std::uint32_t value) {
        std::atomic_ref(sum).fetch_add(value, std::memory_order_relaxed);
      };
      for (std::int64_t i = begin; i < end; ++i) {
        const ListedFlat& flat = left[i];
        for (const std::int32_t v : triangles[flat.triangle]) {
          FlatAround& here = around[v];
          add(here.count, 1);
          add(here.sum.xx, flat.tensor.xx);
          add(here.sum.xy, flat.tensor.xy);
        }
      }
    });
    if (complete) {
      complete(around);
    }
    std::erase_if(left, [&](const ListedFlat& flat) {
      return !std::ranges::all_of(triangles[flat.triangle],
                                  [&](std::int32_t v) { return stay_in_choice(around[v], static_cast<int>(choice)); });
    });
    left_[choice] = std::move(left);
  }
}

std::vector<FlatTriangle> LayerCandidates::after(int choices, Workers& workers) const {
  const std::vector<ListedFlat>& left = left_[choices];
  std::vector<FlatTriangle> candidates(left.size());
  workers.for_blocks(std::ssize(left), triangle_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Triangle corners = canonical_corners(view_, static_cast<std::size_t>(left[i].triangle));
      const auto [a, b, c] = corners;
      candidates[i] = described_flat(corners, view_.points[a], view_.points[b], view_.points[c]);
    }
  });
  return candidates;
}

LayerSearch search_layers(std::span<const FlatTriangle> candidates, std::int32_t vertex_count, Layers layers,
                          std::int64_t least, Workers& workers) {
  LayerSearch found;
  if (std::ssize(candidates) < least) {
    return found;
  }
  const Stretches stretches(candidates, vertex_count, least, workers);
  double kept_quotient = 1;
  double left_quotient = 1;
  for (std::size_t t = 0; t < candidates.size(); ++t) {
    const Stretch& stretch = stretches.of(t);
    if (!stretches.counts(stretch)) {
      continue;
    }
    const Triangle& corners = candidates[t].corners;
    if (stretch.is_clean() || layers == Layers::keep) {
      found.kept.insert(found.kept.end(), corners.begin(), corners.end());
      kept_quotient = std::min(kept_quotient, stretch.smallest_quotient);
    } else if (stretch.is_wide() || stretch.is_band()) {
      for (int i = 0; i < 3; ++i) {
        if (!stretch.is_wide() || stretches.goes_around(t, i)) {
          found.left.push_back(corners[i]);
        }
      }
      left_quotient = std::min(left_quotient, stretch.smallest_quotient);
    }
  }
  make_set(found.kept);
  make_set(found.left);
  if (!found.kept.empty()) {
    found.result.kept_aspect = aspect_of(kept_quotient);
  }
  if (!found.left.empty()) {
    found.result.left_aspect = aspect_of(left_quotient);
  }
  return found;
}

void add_ends(std::span<const FlatTriangle> flat, std::vector<std::int32_t>& kept) {
  std::vector<std::int32_t> ends;
  for (const FlatTriangle& triangle : flat) {
    const auto is_kept = [&kept](std::int32_t v) { return std::ranges::binary_search(kept, v); };
    if (std::ranges::count_if(triangle.corners, is_kept) == 2) {
      ends.push_back(*std::ranges::find_if_not(triangle.corners, is_kept));
    }
  }
  kept.insert(kept.end(), ends.begin(), ends.end());
  make_set(kept);
}

LayerSearch search_layers(const std::function<std::vector<FlatTriangle>(int)>& candidates_after,
                          std::int32_t vertex_count, Layers layers, Workers& workers) {
  const LayerSearch look =
      search_layers(candidates_after(layers_first_choices), vertex_count, layers, layers_least_seen, workers);
  if (!look.finds_any()) {
    return {};
  }
  LayerSearch found = search_layers(candidates_after(layers_choices), vertex_count, layers, layers_least, workers);
  if (!found.kept.empty()) {
    add_ends(candidates_after(0), found.kept);
  }
  return found;
}

LayersResult hold_layers(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                         std::span<const std::uint8_t> reversed, Layers layers, bool slides,
                         std::span<std::uint8_t> fixed, Workers& workers) {
  if (layers == Layers::smooth) {
    return {};
  }
  const LayerCandidates candidates(points, triangles, reversed, workers);
  LayerSearch found = search_layers([&](int choices) { return candidates.after(choices, workers); },
                                    static_cast<std::int32_t>(points.size()), layers, workers);
  for (const std::int32_t v : found.kept) {
    std::uint8_t& reasons = fixed[v];
    if (count_in_layer(reasons, slides, found.result)) {
      reasons |= hold::named;
    }
  }
  found.result.left = std::ranges::count_if(found.left, [fixed](std::int32_t v) { return fixed[v] == 0; });
  return found.result;
}

CutElements cut_into_triangles(std::span<const Point2<double>> points, std::span<const MixedElement> elements,
                               std::span<const std::uint8_t> reversed) {
  CutElements cut;
  cut.triangles.reserve(2 * elements.size());
  cut.reversed.reserve(2 * elements.size());
  const auto take = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::size_t e) {
    cut.triangles.push_back({a, b, c});
    cut.reversed.push_back(reversed[e]);
  };
  for (std::size_t e = 0; e < elements.size(); ++e) {
    // From the smallest corner on, as that decides where the diagonals are of one length.
    const auto [a, b, c, d] = canonical_corners(elements[e], false);
    if (d == no_corner) {
      take(a, b, c, e);
    } else if (squared_length(points[b] - points[d]) < squared_length(points[a] - points[c])) {
      take(a, b, d, e);
      take(b, c, d, e);
    } else {
      take(a, b, c, e);
      take(a, c, d, e);
    }
  }
  return cut;
}

LayersResult hold_layers(std::span<const Point2<double>> points, std::span<const MixedElement> elements,
                         std::span<const std::uint8_t> reversed, Layers layers, bool slides,
                         std::span<std::uint8_t> fixed, Workers& workers) {
  if (layers == Layers::smooth) {
    return {};
  }
  const CutElements cut = cut_into_triangles(points, elements, reversed);
  return hold_layers(points, cut.triangles, cut.reversed, layers, slides, fixed, workers);
}

}  // namespace trismooth
