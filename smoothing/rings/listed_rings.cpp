// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/listed_rings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/release.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/parity_forest.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/smoothing/rings/vertex_rim.h"

namespace trismooth {

namespace {

constexpr std::int64_t listed_grain = 16384;
constexpr int part_bits = 13;  // so many vertices: their rims take 400 KiB, which stay in the cache
constexpr std::int64_t parts_at_once = 256;

/// Walks around the vertices of some parts at once: a part is vertices numbered in a row. The corners of all triangles
/// are sorted by the parts of their vertices, so that what follows happens in the cache, however vertices and triangles
/// are numbered.
///
/// Who gets what is found there is a `Taker`:
/// numbers: how many a corner is: its vertex, the edge opposite of it and, as a fourth, the halfedge that starts there;
/// part(corners): begins a part, whose sorted corners those are, and gives what takes its vertices in their order:
/// meets() is for walk_rim(), then take(vertex, fan, size, halfedges) follows, or skip(vertex) of an isolated one;
/// parts(first, begins, corners): those parts have been walked.
template <class Taker>
class FanSearch {
 public:
  FanSearch(std::int32_t vertex_count, std::span<const Triangle> triangles, Taker& taker,
            std::vector<std::uint8_t>& hold, TriangleComponents& components, Workers& workers)
      : vertex_count_(vertex_count),
        triangles_(triangles),
        taker_(taker),
        hold_(hold),
        components_(components),
        workers_(workers) {}

  /// False where something is not as it has to be.
  bool run() {
    if (!are_faultless()) {
      return false;
    }
    hold_.resize(static_cast<std::size_t>(vertex_count_));
    tree_.resize(static_cast<std::size_t>(vertex_count_));
    // For all of them, though as a rule no more than a part of this memory is ever touched.
    corners_.resize(Taker::numbers * 3 * triangles_.size());
    const std::int64_t parts = (std::int64_t{vertex_count_} + part_size - 1) / part_size;
    const std::int64_t at_once = std::max(parts_at_once, (parts + 3) / 4);
    for (std::int64_t first = 0; first < parts; first += at_once) {
      if (!walk_parts(first, std::min(at_once, parts - first))) {
        return false;
      }
    }
    release(corners_);
    find_components();
    return true;
  }

 private:
  static constexpr std::int64_t part_size = std::int64_t{1} << part_bits;

  bool are_faultless() {
    std::atomic<bool> faulty{false};
    workers_.for_blocks(std::ssize(triangles_), listed_grain, [&](std::int64_t begin, std::int64_t end) {
      bool any = false;
      for (std::int64_t t = begin; t < end; ++t) {
        any |= is_faulty(vertex_count_, triangles_[t]);
      }
      if (any) {
        faulty = true;
      }
    });
    return !faulty;
  }

  /// Parts [first_part, first_part + parts). False where something is not as it has to be.
  bool walk_parts(std::int64_t first_part, std::int64_t parts) {
    const std::vector<std::int64_t> begins = sort_corners(first_part, parts);
    std::atomic<bool> walked_all{true};
    workers_.for_blocks(parts, 1, [&](std::int64_t begin, std::int64_t end) {
      Scratch scratch;
      for (std::int64_t part = begin; part < end && walked_all; ++part) {
        const auto corners =
            std::span(corners_).subspan(static_cast<std::size_t>(Taker::numbers * begins[part]),
                                        static_cast<std::size_t>(Taker::numbers * (begins[part + 1] - begins[part])));
        if (!walk_part(first_part + part, corners, scratch)) {
          walked_all = false;
        }
      }
    });
    if (walked_all) {
      taker_.parts(first_part, begins, corners_);
    }
    return walked_all;
  }

  /// Where each of the parts begins among the sorted corners, and where the last one ends.
  std::vector<std::int64_t> sort_corners(std::int64_t first_part, std::int64_t parts) {
    const auto corners_of = [this, first_part, parts](std::int64_t t, const auto& item) {
      const auto take = [&](std::int32_t vertex, std::int32_t after, std::int32_t before, std::int64_t corner) {
        const auto part = static_cast<std::uint64_t>((vertex >> part_bits) - first_part);
        if (part < static_cast<std::uint64_t>(parts)) {
          item(part, vertex, after, before, static_cast<std::int32_t>(corner));
        }
      };
      const auto& [a, b, c] = triangles_[t];
      take(a, b, c, 3 * t);
      take(b, c, a, 3 * t + 1);
      take(c, a, b, 3 * t + 2);
    };
    const auto put = [this](std::int64_t place, std::int32_t vertex, std::int32_t after, std::int32_t before,
                            std::int32_t corner) {
      std::int32_t* const numbers = corners_.data() + Taker::numbers * place;
      numbers[0] = vertex;
      numbers[1] = after;
      numbers[2] = before;
      if constexpr (Taker::numbers > 3) {
        numbers[3] = corner;
      }
    };
    return counting_sort_of_items(std::ssize(triangles_), parts, corners_of, put, workers_);
  }

  /// What the search of one part needs.
  struct Scratch {
    std::vector<std::int32_t> places = std::vector<std::int32_t>(part_size + 1);
    BulkVector<RimEdge> rims;
    BulkVector<std::int32_t> halfedges;  ///< at the corner of each rim edge, where they are known
  };

  /// Walks around the vertices of one part. False where something is not as it has to be.
  bool walk_part(std::int64_t part, std::span<std::int32_t> corners, Scratch& scratch) {
    const auto first = static_cast<std::int32_t>(part << part_bits);
    const auto size = static_cast<std::int32_t>(std::min<std::int64_t>(part_size, vertex_count_ - first));
    sort_rims(corners, first, scratch);
    auto vertices = taker_.part(corners);
    std::int32_t begin = 0;
    for (std::int32_t i = 0; i < size; ++i) {
      const std::int32_t v = first + i;
      const std::int32_t end = scratch.places[i];
      const auto rim = std::span<const RimEdge>(scratch.rims)
                           .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
      hold_[v] = hold::isolated;
      tree_[v] = static_cast<std::uint32_t>(v) << 1U;
      if (rim.empty()) {
        vertices.skip(v);
        continue;
      }
      const Fan fan = rim.size() > most_rim_edges ? Fan::other : walk_rim(rim, vertices.meets());
      if (fan == Fan::other) {
        return false;
      }
      hold_[v] = fan == Fan::open ? hold::boundary : std::uint8_t{0};
      const RimEdge& any = rim.front();
      tree_[v] = static_cast<std::uint32_t>(std::min({v, any.from, any.to})) << 1U;
      vertices.take(v, fan, std::ssize(rim),
                    std::span<const std::int32_t>(scratch.halfedges)
                        .subspan(Taker::numbers > 3 ? static_cast<std::size_t>(begin) : 0));
      begin = end;
    }
    return true;
  }

  /// Sorts the opposite edges by their vertices: places[i] is then where those of the part's vertex i end.
  static void sort_rims(std::span<const std::int32_t> corners, std::int32_t first, Scratch& scratch) {
    std::ranges::fill(scratch.places, 0);
    scratch.rims.resize(corners.size() / Taker::numbers);
    if constexpr (Taker::numbers > 3) {
      scratch.halfedges.resize(scratch.rims.size());
    }
    for (std::size_t i = 0; i < corners.size(); i += Taker::numbers) {
      ++scratch.places[corners[i] - first + 1];
    }
    std::partial_sum(scratch.places.begin(), scratch.places.end(), scratch.places.begin());
    for (std::size_t i = 0; i < corners.size(); i += Taker::numbers) {
      const std::int32_t place = scratch.places[corners[i] - first]++;
      scratch.rims[place] = {corners[i + 1], corners[i + 2]};
      if constexpr (Taker::numbers > 3) {
        scratch.halfedges[place] = corners[i + 3];
      }
    }
  }

  /// Vertices that share a triangle are of one component, since the triangles of each vertex are one fan.
  void find_components() {
    const ParityForest forest{tree_.data()};
    workers_.for_blocks(std::ssize(triangles_), listed_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t t = begin; t < end; ++t) {
        const auto& [a, b, c] = triangles_[t];
        forest.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), 0);
        forest.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(c), 0);
      }
    });
    components_.alike = true;
    components_.parity.assign(triangles_.size(), 0);
    components_.component.resize(triangles_.size());
    const auto is_root = [&](std::int64_t v) {
      return tree_[v] >> 1U == static_cast<std::uint32_t>(v) && (hold_[v] & hold::isolated) == 0;
    };
    const BulkVector<std::int32_t> roots = numbers_of(vertex_count_, is_root, workers_);
    components_.components = static_cast<std::int32_t>(roots.size());
    if (roots.size() > 1) {
      number_components(forest);
    } else {
      workers_.for_blocks(std::ssize(triangles_), listed_grain, [&](std::int64_t begin, std::int64_t end) {
        std::fill(components_.component.begin() + begin, components_.component.begin() + end, 0);
      });
    }
  }

  /// From 0, in the order of their lowest triangles.
  void number_components(const ParityForest& forest) {
    BulkVector<std::int32_t>& component = components_.component;
    BulkVector<std::int32_t> lowest(static_cast<std::size_t>(vertex_count_));
    workers_.for_blocks(vertex_count_, listed_grain, [&](std::int64_t begin, std::int64_t end) {
      std::fill(lowest.begin() + begin, lowest.begin() + end, -1);
    });
    workers_.for_blocks(std::ssize(triangles_), listed_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t t = begin; t < end; ++t) {
        component[t] = static_cast<std::int32_t>(forest.find(static_cast<std::uint32_t>(triangles_[t][0])).element);
        lower_relaxed(lowest[component[t]], static_cast<std::int32_t>(t));
      }
    });
    for_each_numbered(
        std::ssize(triangles_), [&](std::int64_t t) { return lowest[component[t]] == t; },
        [&](std::int64_t number, std::int64_t t) { tree_[component[t]] = static_cast<std::uint32_t>(number); },
        workers_);
    workers_.for_blocks(std::ssize(triangles_), listed_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t t = begin; t < end; ++t) {
        component[t] = static_cast<std::int32_t>(tree_[component[t]]);
      }
    });
  }

  std::int32_t vertex_count_;
  std::span<const Triangle> triangles_;
  Taker& taker_;
  std::vector<std::uint8_t>& hold_;
  TriangleComponents& components_;
  Workers& workers_;
  BulkVector<std::int32_t> corners_;  ///< of the parts that are looked at
  BulkVector<std::uint32_t> tree_;    ///< of a ParityForest of the vertices
};

/// Takes the rings of vertices.
class RingTaker {
 public:
  static constexpr std::size_t numbers = 3;

  RingTaker(std::int32_t vertex_count, std::size_t triangles, OneRings& rings, Workers& workers)
      : vertex_count_(vertex_count), rings_(rings), workers_(workers) {
    rings_.offsets.resize(static_cast<std::size_t>(vertex_count) + 1);
    rings_.offsets[0] = 0;
    rings_.neighbours.resize(3 * triangles);
  }

  /// Puts rings in the place of the part's corners, one after the other. Their offsets are those within the part.
  class Part {
   public:
    Part(std::span<std::int64_t> offsets, std::int32_t* ring) : offsets_(offsets), ring_(ring) {}
    void skip(std::int32_t vertex) { offsets_[vertex + 1] = written_; }
    auto meets() const {
      return
          [ring = ring_ + written_](std::int32_t i, std::int32_t vertex, std::int32_t /*edge*/) { ring[i] = vertex; };
    }
    void take(std::int32_t vertex, Fan fan, std::int64_t size, std::span<const std::int32_t> /*halfedges*/) {
      written_ += fan == Fan::closed ? size : 0;
      offsets_[vertex + 1] = written_;
    }

   private:
    std::span<std::int64_t> offsets_;
    std::int32_t* ring_;
    std::int64_t written_ = 0;
  };
  Part part(std::span<std::int32_t> corners) { return {rings_.offsets, corners.data()}; }

  /// Moves the rings of some parts from the places of their corners to those behind the rings of the parts before.
  void parts(std::int64_t first_part, std::span<const std::int64_t> begins, std::span<const std::int32_t> corners) {
    BulkVector<std::int64_t>& offsets = rings_.offsets;
    const std::int64_t parts = std::ssize(begins) - 1;
    const auto end_of = [&](std::int64_t part) {
      return std::min<std::int64_t>((first_part + part + 1) << part_bits, vertex_count_);
    };
    std::vector<std::int64_t> before(static_cast<std::size_t>(parts) + 1);
    before[0] = offsets[first_part << part_bits];
    for (std::int64_t part = 0; part < parts; ++part) {
      before[part + 1] = before[part] + offsets[end_of(part)];
    }
    workers_.for_blocks(parts, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t part = begin; part < end; ++part) {
        std::copy_n(corners.begin() + static_cast<std::int64_t>(numbers) * begins[part],
                    before[part + 1] - before[part], rings_.neighbours.begin() + before[part]);
        for (std::int64_t v = (first_part + part) << part_bits; v < end_of(part); ++v) {
          offsets[v + 1] += before[part];
        }
      }
    });
  }

 private:
  std::int32_t vertex_count_;
  OneRings& rings_;
  Workers& workers_;
};

/// Takes which sides of triangles are one edge: around a vertex, the side that leaves it in a triangle is the one that
/// comes back to it in the triangle before.
class SideTaker {
 public:
  static constexpr std::size_t numbers = 4;

  SideTaker(std::int32_t vertex_count, std::size_t triangles, TriangleTopology& topology) : topology_(topology) {
    topology_.vertex_count = vertex_count;
    topology_.corner.resize(static_cast<std::size_t>(vertex_count));
    topology_.degree.resize(static_cast<std::size_t>(vertex_count));
    topology_.twins.resize(3 * triangles);
  }

  class Part {
   public:
    explicit Part(TriangleTopology& topology) : topology_(topology) {}
    void skip(std::int32_t vertex) {
      topology_.corner[vertex] = -1;
      topology_.degree[vertex] = 0;
    }
    auto meets() {
      return [this](std::int32_t i, std::int32_t /*vertex*/, std::int32_t edge) {
        met_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(edge);
      };
    }
    /// `halfedges` begin with those at the corners of the vertex, in the order of the triangles.
    void take(std::int32_t vertex, Fan fan, std::int64_t size, std::span<const std::int32_t> halfedges) {
      topology_.corner[vertex] = halfedges[0];
      topology_.degree[vertex] = static_cast<std::int32_t>(size);
      std::int32_t before =
          fan == Fan::closed ? coming_back(halfedges[met_[static_cast<std::size_t>(size) - 1]]) : MatchedSides::no_twin;
      for (std::int64_t i = 0; i < size; ++i) {
        const std::int32_t leaving = halfedges[met_[static_cast<std::size_t>(i)]];
        topology_.twins[leaving] = before;
        before = coming_back(leaving);
      }
    }

   private:
    static std::int32_t coming_back(std::int32_t leaving) { return leaving % 3 == 0 ? leaving + 2 : leaving - 1; }

    TriangleTopology& topology_;
    std::array<std::uint8_t, most_rim_edges> met_{};
  };
  Part part(std::span<std::int32_t> /*corners*/) { return Part(topology_); }
  void parts(std::int64_t /*first*/, std::span<const std::int64_t> /*begins*/,
             std::span<const std::int32_t> /*corners*/) {}

 private:
  TriangleTopology& topology_;
};

}  // namespace

std::optional<ListedRings> find_listed_rings(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                             Workers& workers) {
  check_mesh_size(vertex_count, std::ssize(triangles));
  ListedRings found;
  RingTaker taker(vertex_count, triangles.size(), found.rings, workers);
  if (!FanSearch(vertex_count, triangles, taker, found.hold, found.components, workers).run()) {
    return std::nullopt;
  }
  found.rings.neighbours.resize(static_cast<std::size_t>(found.rings.offsets.back()));
  return found;
}

std::optional<TriangleTopology> find_listed_topology(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                                     Workers& workers) {
  check_mesh_size(vertex_count, std::ssize(triangles));
  TriangleTopology found;
  SideTaker taker(vertex_count, triangles.size(), found);
  if (!FanSearch(vertex_count, triangles, taker, found.hold, found, workers).run()) {
    return std::nullopt;
  }
  return found;
}

}  // namespace trismooth
