#include "trismooth/smoothing/untangle/untangle.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/guard/guard_rule.h"
#include "trismooth/smoothing/untangle/patch.h"
#include "trismooth/smoothing/untangle/ring_kernel.h"
#include "trismooth/smoothing/untangle/tutte.h"
#include "trismooth/smoothing/untangle/untangling_newton.h"

namespace trismooth {

namespace {

constexpr std::int64_t counting_grain = 4096;

/// Calls visit(triangle) for every triangle around v whose free corner of the smallest number is v.
template <class Visit>
void for_own_triangles(const RingView& rings, std::int32_t v, const Visit& visit) {
  const auto ring = rings[v];
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::int32_t b = ring[k];
    const std::int32_t c = ring[k + 1 == ring.size() ? 0 : k + 1];
    if ((b < v && rings.is_free(b)) || (c < v && rings.is_free(c))) {
      continue;
    }
    visit(Triangle{v, b, c});
  }
}

class Untangler {
 public:
  Untangler(const RingView& rings, std::span<Point2<double>> points, Workers& workers)
      : rings_(rings), points_(points), workers_(workers), listed_(points.size(), 0), cutter_(rings, mesh_size()) {
    find_inverted();
  }

  UntangleOutcome run() {
    UntangleOutcome outcome;
    const std::vector<Point2<double>> input(points_.begin(), points_.end());
    outcome.inverted_before = inverted_count();
    auto mended_since = [&, last = inverted_count()]() mutable {
      const std::int64_t mended = last - inverted_count();
      last = inverted_count();
      return mended;
    };
    const auto move_to_means = [&](std::int32_t v) { move_to_mean(v); };
    const auto move_to_kernels = [&](std::int32_t v) { move_to_kernel(v); };
    move_corners(move_to_means, 12);
    outcome.by_averages = mended_since();
    move_corners(move_to_kernels, 4);
    outcome.by_kernels = mended_since();
    for (std::int64_t rings = 2; !inverted_.empty(); rings *= 2) {
      const bool is_all = solve_parts(rings, outcome);
      if (is_all) {
        break;
      }
    }
    outcome.inverted_after = inverted_count();
    return outcome;
  }

 private:
  std::int32_t mesh_size() const { return static_cast<std::int32_t>(points_.size()); }
  std::int64_t inverted_count() const { return std::ssize(inverted_); }

  bool is_inverted(const Triangle& triangle) const {
    const auto [a, b, c] = triangle;
    return !(canonical_quotient(points_[a], points_[b], points_[c], rings_.input(a), rings_.input(b),
                                rings_.input(c)) > 0);
  }

  bool comes_first(std::int32_t a, std::int32_t b) const { return rings_.input(a) < rings_.input(b); }

  /// In the order of the input: nothing that is found may depend on how the rings are numbered.
  void sort_by_input(std::vector<std::int32_t>& vertices) const {
    std::ranges::sort(vertices, {}, [&](std::int32_t v) { return rings_.input(v); });
  }

  /// All inverted triangles of the mesh.
  void find_inverted() {
    inverted_.clear();
    std::mutex joining;
    workers_.for_blocks(rings_.size(), counting_grain, [&](std::int64_t begin, std::int64_t end) {
      std::vector<Triangle> found;
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        for_own_triangles(rings_, v, [&](const Triangle& triangle) {
          if (is_inverted(triangle)) {
            found.push_back(triangle);
          }
        });
      }
      const std::lock_guard lock(joining);
      inverted_.insert(inverted_.end(), found.begin(), found.end());
    });
  }

  /// The free corners of the inverted triangles, each once, in the order of the input.
  std::vector<std::int32_t> corners() {
    std::vector<std::int32_t> found;
    for (const Triangle& triangle : inverted_) {
      for (const std::int32_t v : triangle) {
        if (rings_.is_free(v) && listed_[v] == 0) {
          listed_[v] = 1;
          found.push_back(v);
        }
      }
    }
    unlist(found);
    sort_by_input(found);
    return found;
  }

  void unlist(std::span<const std::int32_t> vertices) {
    for (const std::int32_t v : vertices) {
      listed_[v] = 0;
    }
  }

  /// The inverted triangles around `moved` vertices, each once.
  std::vector<Triangle> inverted_around(std::span<const std::int32_t> moved) {
    for (const std::int32_t v : moved) {
      listed_[v] = 1;
    }
    std::vector<Triangle> found;
    for (const std::int32_t v : moved) {
      const auto ring = rings_[v];
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::int32_t b = ring[k];
        const std::int32_t c = ring[k + 1 == ring.size() ? 0 : k + 1];
        if ((b < v && listed_[b] != 0) || (c < v && listed_[c] != 0)) {
          continue;
        }
        if (is_inverted({v, b, c})) {
          found.push_back({v, b, c});
        }
      }
    }
    unlist(moved);
    return found;
  }

  void move_to_mean(std::int32_t v) {
    const auto ring = rings_[v];
    Point2<double> sum{0, 0};
    for (const std::int32_t neighbour : ring) {
      sum.x += points_[neighbour].x;
      sum.y += points_[neighbour].y;
    }
    const auto count = static_cast<double>(ring.size());
    points_[v] = {sum.x / count, sum.y / count};
  }

  std::int64_t inverted_at(std::int32_t v) const {
    const auto ring = rings_[v];
    std::int64_t inverted = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      inverted += is_inverted({v, ring[k], ring[k + 1 == ring.size() ? 0 : k + 1]}) ? 1 : 0;
    }
    return inverted;
  }

  void move_to_kernel(std::int32_t v) {
    if (inverted_at(v) == 0) {
      return;
    }
    ring_points_.clear();
    for (const std::int32_t neighbour : rings_[v]) {
      ring_points_.push_back(points_[neighbour]);
    }
    const auto centre = kernel_centre(ring_points_, scratch_);
    if (!centre) {
      return;
    }
    const Point2<double> old = points_[v];
    points_[v] = *centre;
    if (inverted_at(v) != 0) {
      points_[v] = old;
    }
  }

  /// Moves the corners of inverted triangles, one after the other, for some passes, and keeps the best of them.
  template <class Move>
  void move_corners(const Move& move, int most_passes) {
    if (inverted_.empty()) {
      return;
    }
    std::vector<Point2<double>> best_points(points_.begin(), points_.end());
    std::vector<Triangle> best = inverted_;
    int passes_in_vain = 0;
    for (int pass = 0; pass < most_passes && !inverted_.empty() && passes_in_vain < 2; ++pass) {
      const std::vector<std::int32_t> moved = corners();
      for (const std::int32_t v : moved) {
        move(v);
      }
      inverted_ = inverted_around(moved);
      if (inverted_.size() < best.size()) {
        best = inverted_;
        best_points.assign(points_.begin(), points_.end());
        passes_in_vain = 0;
      } else {
        ++passes_in_vain;
      }
    }
    std::ranges::copy(best_points, points_.begin());
    inverted_ = std::move(best);
  }

  /// Cuts out the parts of the mesh within `rings` of inverted triangles and solves each by itself. Returns whether
  /// they could not have been larger.
  bool solve_parts(std::int64_t rings, UntangleOutcome& outcome) {
    std::vector<std::int32_t> near = corners();
    for (const std::int32_t v : near) {
      listed_[v] = 1;
    }
    std::size_t done = 0;
    bool is_all = false;
    for (std::int64_t ring = 0; ring < rings; ++ring) {
      const std::size_t end = near.size();
      for (; done < end; ++done) {
        for (const std::int32_t neighbour : rings_[near[done]]) {
          if (rings_.is_free(neighbour) && listed_[neighbour] == 0) {
            listed_[neighbour] = 1;
            near.push_back(neighbour);
          }
        }
      }
      if (near.size() == end) {
        is_all = true;
        break;
      }
    }
    // Parts that do not hang together are solved apart: listed_ is 1 for who waits for a part.
    std::vector<std::int32_t> seeds = near;
    std::vector<std::int32_t> part;
    for (const std::int32_t seed : seeds) {
      if (listed_[seed] != 1) {
        continue;
      }
      part.assign(1, seed);
      listed_[seed] = 2;
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (const std::int32_t neighbour : rings_[part[i]]) {
          if (listed_[neighbour] == 1) {
            listed_[neighbour] = 2;
            part.push_back(neighbour);
          }
        }
      }
      solve(part, outcome);
    }
    unlist(near);
    find_inverted();
    return is_all;
  }

  /// Solves one part; keeps the result where it has fewer inverted triangles.
  void solve(std::span<const std::int32_t> part, UntangleOutcome& outcome) {
    const Patch patch = cutter_.cut(part);
    if (patch.vertex_count() == patch.free_count) {
      return;  // nothing holds it: a closed surface, laid flat
    }
    std::vector<Point2<double>> points;
    for (const std::int32_t v : patch.vertices) {
      points.push_back(points_[v]);
    }
    const std::int64_t before = trismooth::inverted_triangles(patch, points, workers_);
    if (before == 0) {
      return;
    }
    std::vector<Point2<double>> best = points;
    std::int64_t fewest = before;
    const auto keep_if_better = [&](const std::vector<Point2<double>>& found, std::int64_t& mended) {
      const std::int64_t inverted = trismooth::inverted_triangles(patch, found, workers_);
      if (inverted < fewest) {
        mended += fewest - inverted;
        fewest = inverted;
        best = found;
      }
    };
    std::vector<Point2<double>> embedded = points;
    for (const double tolerance : {1e-6, 1e-9, 1e-13}) {
      tutte(patch, embedded, tolerance, workers_);
      keep_if_better(embedded, outcome.by_embedding);
      if (fewest == 0) {
        break;
      }
    }
    if (fewest > 0) {
      std::vector<Point2<double>> lowered = embedded;
      minimise_regularised(patch, lowered, most_newton_steps, workers_);
      keep_if_better(lowered, outcome.by_energy);
    }
    if (fewest > 0) {
      std::vector<Point2<double>> lowered = points;
      minimise_regularised(patch, lowered, most_newton_steps, workers_);
      keep_if_better(lowered, outcome.by_energy);
    }
    if (fewest < before) {
      for (std::size_t v = 0; v < part.size(); ++v) {
        points_[part[v]] = best[v];
      }
    }
  }

  static constexpr int most_newton_steps = 100;

  const RingView& rings_;
  std::span<Point2<double>> points_;
  Workers& workers_;
  std::vector<Triangle> inverted_;     ///< the inverted triangles of now
  std::vector<std::uint8_t> listed_;   ///< marks of vertices, 0 between two uses
  PatchCutter cutter_;
  std::vector<Point2<double>> ring_points_;
  std::vector<Point2<double>> scratch_;
};

}  // namespace

std::int64_t inverted_triangles(const RingView& rings, std::span<const Point2<double>> points, Workers& workers) {
  std::atomic<std::int64_t> total{0};
  workers.for_blocks(rings.size(), counting_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t inverted = 0;
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      for_own_triangles(rings, v, [&](const Triangle& t) {
        inverted += canonical_quotient(points[t[0]], points[t[1]], points[t[2]], rings.input(t[0]), rings.input(t[1]),
                                       rings.input(t[2])) > 0
                        ? 0
                        : 1;
      });
    }
    total.fetch_add(inverted, std::memory_order_relaxed);
  });
  return total;
}

UntangleOutcome untangle(const RingView& rings, std::span<Point2<double>> points, Workers& workers) {
  if (inverted_triangles(rings, points, workers) == 0) {
    return {};
  }
  return Untangler(rings, points, workers).run();
}

}  // namespace trismooth
