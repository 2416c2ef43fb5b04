#include "trismooth/smoothing/rings/listed_rings.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/counting_sort.h"
#include "trismooth/base/hold.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/parity_forest.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/relaxed_atomics.h"
#include "trismooth/base/release.h"
#include "trismooth/base/workers.h"
#include "trismooth/smoothing/rings/vertex_link.h"

namespace trismooth {

namespace {

constexpr std::int64_t listed_grain = 16384;
constexpr int part_bits = 13;  // so many vertices: their links take 400 KiB, which stay in the cache
constexpr std::int64_t parts_at_once = 256;

/// A corner of a triangle is three numbers: its vertex and the edge opposite of it.
constexpr std::int64_t numbers_a_corner = 3;

/// Finds the rings of some parts at once: a part is vertices numbered in a row. The corners of all triangles are sorted
/// by the parts of their vertices, so that what follows happens in the cache, however vertices and triangles are
/// numbered.
class RingSearch {
 public:
  RingSearch(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers)
      : vertex_count_(vertex_count), triangles_(triangles), workers_(workers) {}

  std::optional<ListedRings> run() {
    if (!are_faultless()) {
      return std::nullopt;
    }
    found_.hold.resize(static_cast<std::size_t>(vertex_count_));
    found_.rings.offsets.resize(static_cast<std::size_t>(vertex_count_) + 1);
    found_.rings.offsets[0] = 0;
    found_.rings.neighbours.resize(3 * triangles_.size());
    tree_.resize(static_cast<std::size_t>(vertex_count_));
    // For all of them, though as a rule no more than a part of this memory is ever touched.
    corners_.resize(numbers_a_corner * 3 * triangles_.size());
    const std::int64_t parts = (std::int64_t{vertex_count_} + part_size - 1) / part_size;
    const std::int64_t at_once = std::max(parts_at_once, (parts + 3) / 4);
    for (std::int64_t first = 0; first < parts; first += at_once) {
      if (!find_rings(first, std::min(at_once, parts - first))) {
        return std::nullopt;
      }
    }
    found_.rings.neighbours.resize(static_cast<std::size_t>(found_.rings.offsets.back()));
    release(corners_);
    find_components();
    return std::move(found_);
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

  /// Those of parts [first_part, first_part + parts). False where something is not as it has to be.
  bool find_rings(std::int64_t first_part, std::int64_t parts) {
    const std::vector<std::int64_t> begins = sort_corners(first_part, parts);
    std::atomic<bool> found_all{true};
    workers_.for_blocks(parts, 1, [&](std::int64_t begin, std::int64_t end) {
      Scratch scratch;
      for (std::int64_t part = begin; part < end && found_all; ++part) {
        const auto corners =
            std::span(corners_).subspan(static_cast<std::size_t>(numbers_a_corner * begins[part]),
                                        static_cast<std::size_t>(numbers_a_corner * (begins[part + 1] - begins[part])));
        if (!find_rings(first_part + part, corners, scratch)) {
          found_all = false;
        }
      }
    });
    if (found_all) {
      lay_rings_down(first_part, begins);
    }
    return found_all;
  }

  /// Where each of the parts begins among the sorted corners, and where the last one ends.
  std::vector<std::int64_t> sort_corners(std::int64_t first_part, std::int64_t parts) {
    const auto corners_of = [this, first_part, parts](std::int64_t t, const auto& item) {
      const auto take = [&](std::int32_t vertex, std::int32_t after, std::int32_t before) {
        const auto part = static_cast<std::uint64_t>((vertex >> part_bits) - first_part);
        if (part < static_cast<std::uint64_t>(parts)) {
          item(part, vertex, after, before);
        }
      };
      const auto& [a, b, c] = triangles_[t];
      take(a, b, c);
      take(b, c, a);
      take(c, a, b);
    };
    const auto put = [this](std::int64_t place, std::int32_t vertex, std::int32_t after, std::int32_t before) {
      std::int32_t* const corner = corners_.data() + numbers_a_corner * place;
      corner[0] = vertex;
      corner[1] = after;
      corner[2] = before;
    };
    return counting_sort_of_items(std::ssize(triangles_), parts, corners_of, put, workers_);
  }

  /// What the search of one part needs.
  struct Scratch {
    std::vector<std::int32_t> places = std::vector<std::int32_t>(part_size + 1);
    BulkVector<LinkEdge> links;
  };

  /// Those of one part, from its corners, in whose place they are put, one after the other. Their offsets are those
  /// within the part. False where something is not as it has to be.
  bool find_rings(std::int64_t part, std::span<std::int32_t> corners, Scratch& scratch) {
    const auto first = static_cast<std::int32_t>(part << part_bits);
    const auto size = static_cast<std::int32_t>(std::min<std::int64_t>(part_size, vertex_count_ - first));
    sort_links(corners, first, scratch);
    std::int32_t begin = 0;
    std::int64_t written = 0;
    for (std::int32_t i = 0; i < size; ++i) {
      const std::int32_t v = first + i;
      const std::int32_t end = scratch.places[i];
      const auto link = std::span<const LinkEdge>(scratch.links)
                            .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
      begin = end;
      found_.hold[v] = hold::isolated;
      tree_[v] = static_cast<std::uint32_t>(v) << 1U;
      if (!link.empty()) {
        std::int32_t* const ring = corners.data() + written;
        const Fan fan = link.size() > most_link_edges ? Fan::other : walk_link(link, ring);
        if (fan == Fan::other) {
          return false;
        }
        found_.hold[v] = fan == Fan::open ? hold::boundary : std::uint8_t{0};
        written += fan == Fan::closed ? std::ssize(link) : 0;
        const LinkEdge& any = link.front();
        tree_[v] = static_cast<std::uint32_t>(std::min({v, any.from, any.to})) << 1U;
      }
      found_.rings.offsets[v + 1] = written;
    }
    return true;
  }

  /// Sorts the opposite edges by their vertices: places[i] is then where those of the part's vertex i end.
  static void sort_links(std::span<const std::int32_t> corners, std::int32_t first, Scratch& scratch) {
    std::ranges::fill(scratch.places, 0);
    scratch.links.resize(corners.size() / numbers_a_corner);
    for (std::size_t i = 0; i < corners.size(); i += numbers_a_corner) {
      ++scratch.places[corners[i] - first + 1];
    }
    std::partial_sum(scratch.places.begin(), scratch.places.end(), scratch.places.begin());
    for (std::size_t i = 0; i < corners.size(); i += numbers_a_corner) {
      scratch.links[scratch.places[corners[i] - first]++] = {corners[i + 1], corners[i + 2]};
    }
  }

  /// Moves the rings of some parts from the places of their corners to those behind the rings of the parts before.
  void lay_rings_down(std::int64_t first_part, std::span<const std::int64_t> begins) {
    BulkVector<std::int64_t>& offsets = found_.rings.offsets;
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
        std::copy_n(corners_.begin() + numbers_a_corner * begins[part], before[part + 1] - before[part],
                    found_.rings.neighbours.begin() + before[part]);
        for (std::int64_t v = (first_part + part) << part_bits; v < end_of(part); ++v) {
          offsets[v + 1] += before[part];
        }
      }
    });
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
    TriangleComponents& components = found_.components;
    components.alike = true;
    components.parity.assign(triangles_.size(), 0);
    components.component.resize(triangles_.size());
    const auto is_root = [&](std::int64_t v) {
      return tree_[v] >> 1U == static_cast<std::uint32_t>(v) && (found_.hold[v] & hold::isolated) == 0;
    };
    const BulkVector<std::int32_t> roots = numbers_of(vertex_count_, is_root, workers_);
    components.components = static_cast<std::int32_t>(roots.size());
    if (roots.size() > 1) {
      number_components(forest);
    } else {
      workers_.for_blocks(std::ssize(triangles_), listed_grain, [&](std::int64_t begin, std::int64_t end) {
        std::fill(components.component.begin() + begin, components.component.begin() + end, 0);
      });
    }
  }

  /// From 0, in the order of their lowest triangles.
  void number_components(const ParityForest& forest) {
    BulkVector<std::int32_t>& component = found_.components.component;
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
  Workers& workers_;
  ListedRings found_;
  BulkVector<std::int32_t> corners_;  ///< of the parts that are looked at
  BulkVector<std::uint32_t> tree_;    ///< of a ParityForest of the vertices
};

}  // namespace

std::optional<ListedRings> find_listed_rings(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                             Workers& workers) {
  check_mesh_size(vertex_count, std::ssize(triangles));
  return RingSearch(vertex_count, triangles, workers).run();
}

}  // namespace trismooth
