// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/triangle_topology.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/base/edge_matching.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/parity_forest.h"
#include "trismooth/base/prefix_sums.h"

namespace trismooth {

namespace {

constexpr std::int64_t topology_grain = 4096;

/// Elements of one array: triangles, or with quadrilaterals among them.
template <class Corners>
using Elements = std::span<const Corners>;

/// Halfedges an element of the array.
template <class Corners>
constexpr std::int32_t stride = sides_of<Elements<Corners>>;

/// What an error calls one.
template <class Corners>
constexpr std::string_view element_name = stride<Corners> == 3 ? "triangle" : "element";

/// Calls body(element, corners that it has) for each, on all workers.
template <class Corners, class Body>
void for_elements(Elements<Corners> elements, Workers& workers, const Body& body) {
  workers.for_blocks(std::ssize(elements), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      body(e, corner_count(elements[e]));
    }
  });
}

/// Checks the elements, and finds the lowest corner of every vertex.
template <class Corners>
void find_corners(Elements<Corners> elements, MatchedSides& sides, Workers& workers) {
  workers.for_blocks(sides.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::fill(sides.corner.begin() + begin, sides.corner.begin() + end, -1);
  });
  std::atomic<bool> faulty{false};
  workers.for_blocks(std::ssize(elements), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      if (is_faulty(sides.vertex_count, elements[e])) {
        faulty = true;
        return;
      }
      for (std::int32_t i = 0; i < corner_count(elements[e]); ++i) {
        lower_relaxed(sides.corner[elements[e][i]], static_cast<std::int32_t>(stride<Corners> * e + i));
      }
    }
  });
  if (faulty) {
    check_triangles(sides.vertex_count, elements);
  }
}

/// Takes edges between two ghosts for edges of many elements: it is not known how many there are.
template <class Corners>
void part_at_ghosts(Elements<Corners> elements, std::span<const std::uint8_t> ghosts, MatchedSides& sides,
                    Workers& workers) {
  for_elements(elements, workers, [&](std::int64_t e, std::int32_t corners) {
    for (std::int32_t i = 0; i < corners; ++i) {
      if (ghosts[elements[e][i]] != 0 && ghosts[elements[e][(i + 1) % corners]] != 0) {
        sides.twins[stride<Corners> * e + i] = MatchedSides::many_twins;
      }
    }
  });
}

/// Marks isolated vertices and those of boundary and non-manifold edges.
template <class Corners>
void mark_held(Elements<Corners> elements, MatchedSides& sides, Workers& workers) {
  workers.for_blocks(sides.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      sides.hold[v] = sides.corner[v] < 0 ? hold::isolated : std::uint8_t{0};
    }
  });
  for_elements(elements, workers, [&](std::int64_t e, std::int32_t corners) {
    for (std::int32_t i = 0; i < corners; ++i) {
      if (const std::int32_t twin = sides.twins[stride<Corners> * e + i]; twin < 0) {
        const std::uint8_t bit = twin == MatchedSides::no_twin ? hold::boundary : hold::non_manifold;
        set_bits_relaxed(sides.hold[elements[e][i]], bit);
        set_bits_relaxed(sides.hold[elements[e][(i + 1) % corners]], bit);
      }
    }
  });
}

/// Whether the elements on both sides of a halfedge are listed against each other (1) or alike (0): then they run
/// through their edge in opposite directions.
template <class Corners>
std::uint32_t are_against(Elements<Corners> elements, std::int64_t halfedge, std::int32_t twin) {
  return start_of(elements, static_cast<std::int32_t>(halfedge)) == start_of(elements, twin) ? 1 : 0;
}

/// Joins the two elements of every edge whose lower element is in [begin, end). False where an edge contradicts the
/// others.
template <class Corners>
bool join_neighbours(const ParityForest& forest, Elements<Corners> elements, std::span<const std::int32_t> twins,
                     std::int64_t begin, std::int64_t end) {
  constexpr std::int32_t sides = stride<Corners>;
  for (std::int64_t e = begin; e < end; ++e) {
    for (std::int64_t h = sides * e; h < sides * e + sides; ++h) {
      const std::int32_t twin = twins[h];
      if (twin > h && forest.join(static_cast<std::uint32_t>(e), static_cast<std::uint32_t>(twin / sides),
                                  are_against(elements, h, twin)) == ParityForest::Join::contradicted) {
        return false;
      }
    }
  }
  return true;
}

/// Throws the error of a component that cannot be oriented. Which edge contradicts the others depends on the order: the
/// one to name is found in that of the halfedges.
template <class Corners>
[[noreturn]] void throw_one_sided(const ParityForest& forest, Elements<Corners> elements,
                                  std::span<const std::int32_t> twins) {
  constexpr std::int32_t sides = stride<Corners>;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    forest.plant(static_cast<std::uint32_t>(e));
  }
  std::int64_t h = 0;
  while (twins[h] <= h ||
         forest.join(static_cast<std::uint32_t>(h / sides), static_cast<std::uint32_t>(twins[h] / sides),
                     are_against(elements, h, twins[h])) != ParityForest::Join::contradicted) {
    ++h;
  }
  const std::string name(element_name<Corners>);
  throw MeshError("the " + name + "s connected with " + name + " " + std::to_string(h / sides) +
                  " cannot be oriented consistently (a one-sided surface" +
                  (sides == 4 ? ", or a quadrilateral whose corners are not listed in turn)" : ")"));
}

template <class Corners>
void find_components(Elements<Corners> elements, MatchedSides& sides, Workers& workers) {
  const std::int64_t count = std::ssize(elements);
  BulkVector<std::uint32_t> words(elements.size());
  const ParityForest forest{words.data()};
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      forest.plant(static_cast<std::uint32_t>(e));
    }
  });
  std::atomic<bool> contradicted{false};
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    if (!join_neighbours(forest, elements, sides.twins, begin, end)) {
      contradicted = true;
    }
  });
  if (contradicted) {
    throw_one_sided(forest, elements, sides.twins);
  }
  sides.parity.resize(elements.size());
  sides.component.resize(elements.size());
  std::atomic<bool> against{false};
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t any = 0;
    for (std::int64_t e = begin; e < end; ++e) {
      const auto root = forest.find(static_cast<std::uint32_t>(e));
      sides.parity[e] = static_cast<std::uint8_t>(root.parity);
      sides.component[e] = static_cast<std::int32_t>(root.element);
      any |= root.parity;
    }
    if (any != 0) {
      against = true;
    }
  });
  sides.alike = !against;
  // A root's word has served, and takes its component's number.
  sides.components = static_cast<std::int32_t>(for_each_numbered(
      count, [&](std::int64_t e) { return sides.component[e] == e; },
      [&](std::int64_t number, std::int64_t e) { words[e] = static_cast<std::uint32_t>(number); }, workers));
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      sides.component[e] = static_cast<std::int32_t>(words[sides.component[e]]);
    }
  });
}

/// The corners of the fan that `first` is in.
template <class Around>
std::int32_t fan_size(const Around& corners, std::int32_t first) {
  std::int32_t size = 1;
  std::int32_t corner = corners.after(first);
  for (; corner >= 0 && corner != first; corner = corners.after(corner)) {
    ++size;
  }
  if (corner < 0) {
    // An open fan: walk to its other end as well.
    for (corner = corners.before(first); corner >= 0; corner = corners.before(corner)) {
      ++size;
    }
  }
  return size;
}

/// Calls visit(vertex, corner) for the lowest corner of every vertex. In the order of the elements: files list them
/// with more locality than vertices.
template <class Corners, class Visit>
void for_lowest_corners(Elements<Corners> elements, const MatchedSides& sides, Workers& workers, const Visit& visit) {
  for_elements(elements, workers, [&](std::int64_t e, std::int32_t corners) {
    for (std::int32_t i = 0; i < corners; ++i) {
      const std::int32_t v = elements[e][i];
      if (const auto corner = static_cast<std::int32_t>(stride<Corners> * e + i); sides.corner[v] == corner) {
        visit(v, corner);
      }
    }
  });
}

/// All corners of the elements.
template <class Corners>
std::int64_t count_corners(Elements<Corners> elements, Workers& workers) {
  if constexpr (stride<Corners> == 3) {
    return 3 * std::ssize(elements);
  }
  std::atomic<std::int64_t> count{0};
  workers.for_blocks(std::ssize(elements), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t of_block = 0;
    for (std::int64_t e = begin; e < end; ++e) {
      of_block += corner_count(elements[e]);
    }
    count.fetch_add(of_block, std::memory_order_relaxed);
  });
  return count;
}

/// Counts the elements of each vertex, and marks vertices whose elements form more than one fan.
template <class Corners>
void find_fans(Elements<Corners> elements, TriangleTopology& topology, Workers& workers) {
  topology.degree.resize(static_cast<std::size_t>(topology.vertex_count));
  workers.for_blocks(topology.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::fill(topology.degree.begin() + begin, topology.degree.begin() + end, 0);
  });
  with_corners(topology, elements, topology.parity, workers, [&](const auto& corners) {
    for_lowest_corners(elements, topology, workers,
                       [&](std::int32_t v, std::int32_t corner) { topology.degree[v] = fan_size(corners, corner); });
  });
  std::atomic<std::int64_t> in_fans{0};
  workers.for_blocks(topology.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    in_fans.fetch_add(std::accumulate(topology.degree.begin() + begin, topology.degree.begin() + end, std::int64_t{0}),
                      std::memory_order_relaxed);
  });
  if (in_fans == count_corners(elements, workers)) {
    return;
  }
  // There are corners outside of the first fans of their vertices.
  BulkVector<std::int32_t> fan = std::move(topology.degree);
  topology.degree.assign(static_cast<std::size_t>(topology.vertex_count), 0);
  for_elements(elements, workers, [&](std::int64_t e, std::int32_t corners) {
    for (std::int32_t i = 0; i < corners; ++i) {
      std::atomic_ref(topology.degree[elements[e][i]]).fetch_add(1, std::memory_order_relaxed);
    }
  });
  workers.for_blocks(topology.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      if (fan[v] != topology.degree[v]) {
        topology.hold[v] |= hold::bow_tie;
      }
    }
  });
}

template <class Corners>
void check(std::int32_t vertex_count, Elements<Corners> elements) {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto corners = std::span(elements[e]).first(static_cast<std::size_t>(corner_count(elements[e])));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (stride<Corners> == 4 && corners[i] == no_corner) {
        throw MeshError("element " + std::to_string(e) +
                        " names vertex -1, which is no vertex: only the last of four numbers is -1, of a triangle");
      }
      if (corners[i] < 0 || corners[i] >= vertex_count) {
        throw_no_such_vertex(static_cast<std::int64_t>(e), std::to_string(corners[i]), vertex_count,
                             element_name<Corners>);
      }
    }
    if (is_faulty(vertex_count, elements[e])) {
      const bool is_padded = corners.size() == 4 && corners[3] == corners[2];
      throw MeshError(std::string(element_name<Corners>) + " " + std::to_string(e) + " repeats a vertex" +
                      (is_padded ? "; of a triangle the last of four numbers is -1" : ""));
    }
  }
}

template <class Corners>
MatchedSides sides_matched(std::int32_t vertex_count, Elements<Corners> elements, Workers& workers,
                           std::span<const std::uint8_t> ghosts) {
  check_mesh_size(vertex_count, std::ssize(elements), stride<Corners>);
  MatchedSides sides;
  sides.vertex_count = vertex_count;
  sides.corner.resize(static_cast<std::size_t>(vertex_count));
  find_corners(elements, sides, workers);
  sides.twins.resize(stride<Corners> * elements.size());
  match_edges(elements, sides.corner, sides.twins, workers);
  if (!ghosts.empty()) {
    part_at_ghosts(elements, ghosts, sides, workers);
  }
  sides.hold.resize(static_cast<std::size_t>(vertex_count));
  mark_held(elements, sides, workers);
  find_components(elements, sides, workers);
  return sides;
}

template <class Corners>
TriangleTopology elements_connected(std::int32_t vertex_count, Elements<Corners> elements, Workers& workers,
                                    std::span<const std::uint8_t> ghosts) {
  TriangleTopology topology{sides_matched(vertex_count, elements, workers, ghosts), {}};
  find_fans(elements, topology, workers);
  return topology;
}

}  // namespace

void check_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles) {
  check(vertex_count, triangles);
}
void check_triangles(std::int32_t vertex_count, std::span<const MixedElement> elements) {
  check(vertex_count, elements);
}

Uniform uniform(std::span<const std::uint8_t> flags, Workers& workers) {
  std::atomic<bool> has_zero{false};
  std::atomic<bool> has_one{false};
  workers.for_blocks(std::ssize(flags), 8 * topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t ones = 0;
    for (std::int64_t i = begin; i < end; ++i) {
      ones += flags[i] != 0 ? 1 : 0;
    }
    if (ones > 0) {
      has_one = true;
    }
    if (ones < end - begin) {
      has_zero = true;
    }
  });
  return {!has_one, !has_zero};
}

MatchedSides match_sides(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                         std::span<const std::uint8_t> ghosts) {
  return sides_matched(vertex_count, triangles, workers, ghosts);
}
MatchedSides match_sides(std::int32_t vertex_count, std::span<const MixedElement> elements, Workers& workers,
                         std::span<const std::uint8_t> ghosts) {
  return sides_matched(vertex_count, elements, workers, ghosts);
}

TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                                   std::span<const std::uint8_t> ghosts) {
  return elements_connected(vertex_count, triangles, workers, ghosts);
}
TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const MixedElement> elements, Workers& workers,
                                   std::span<const std::uint8_t> ghosts) {
  return elements_connected(vertex_count, elements, workers, ghosts);
}

}  // namespace trismooth
