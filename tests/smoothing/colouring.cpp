// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/colouring.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "support/hostile_meshes.h"
#include "support/naive_smoothing.h"
#include "support/test_meshes.h"

using test_meshes::Mesh;
using trismooth::colour_free_vertices;
using trismooth::Colouring;
using trismooth::RingView;
using trismooth::Workers;

namespace {

/// Rings in memory of their own, in any numbering.
struct Graph {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> input_index;

  RingView view() const { return {offsets, neighbours, input_index}; }
};

/// `rings` with vertex order[v] as vertex v.
Graph renumbered(const naive::Rings& rings, const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> number(order.size());
  for (std::size_t v = 0; v < order.size(); ++v) {
    number[order[v]] = static_cast<std::int32_t>(v);
  }
  Graph graph;
  graph.input_index = order;
  for (const std::int32_t v : order) {
    for (const std::int32_t neighbour : rings[v]) {
      graph.neighbours.push_back(number[neighbour]);
    }
    graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  return graph;
}

std::vector<std::int32_t> identity(std::size_t size) {
  std::vector<std::int32_t> order(size);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

/// Colours by input index, from the serial algorithm; -1 for vertices without a ring.
std::vector<std::int32_t> serial_colours(const naive::Rings& rings) {
  std::vector<std::int32_t> colours(rings.size(), -1);
  std::int32_t colour = 0;
  for (const auto& vertices : naive::colour_classes(rings)) {
    for (const std::int32_t v : vertices) {
      colours[v] = colour;
    }
    ++colour;
  }
  return colours;
}

std::vector<std::int32_t> colours_by_input(const Graph& graph, const Colouring& colouring) {
  std::vector<std::int32_t> colours(colouring.colours.size());
  for (std::size_t v = 0; v < colours.size(); ++v) {
    colours[graph.input_index[v]] = colouring.colours[v];
  }
  return colours;
}

}  // namespace

TEST_CASE("the colours are those of the serial greedy colouring, whatever the numbering of the view") {
  Workers workers(1);
  for (const auto& [name, mesh] : test_meshes::zoo()) {
    CAPTURE(name);
    const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
    const std::vector<std::int32_t> expected = serial_colours(rings);
    std::vector<std::int32_t> order = identity(rings.size());
    test_meshes::Random random(1);
    for (int i = 0; i < 5; ++i) {
      const Graph graph = renumbered(rings, order);
      const Colouring found = colour_free_vertices(graph.view(), workers);
      CHECK(colours_by_input(graph, found) == expected);
      CHECK(found.count == *std::ranges::max_element(expected) + 1);
      random.shuffle(order);
    }
  }
}

TEST_CASE("the colours do not depend on the number of threads, and neighbours never share one") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(130, 130, 0.3, 1), 2);
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  const std::vector<std::int32_t> expected = serial_colours(rings);
  const Graph graph = renumbered(rings, identity(rings.size()));
  for (const int threads : {1, 2, 3, 8}) {
    CAPTURE(threads);
    Workers workers(threads);
    const Colouring found = colour_free_vertices(graph.view(), workers);
    CHECK(found.colours == expected);
    for (std::size_t v = 0; v < rings.size(); ++v) {
      for (const std::int32_t neighbour : rings[v]) {
        REQUIRE((found.colours[v] != found.colours[neighbour] || found.colours[v] < 0));
      }
    }
  }
}

TEST_CASE("more than 64 colours are found where the rings need them") {
  constexpr std::int32_t size = 150;
  naive::Rings complete(size);
  for (std::int32_t v = 0; v < size; ++v) {
    for (std::int32_t neighbour = 0; neighbour < size; ++neighbour) {
      if (neighbour != v) {
        complete[v].push_back(neighbour);
      }
    }
  }
  Workers workers(1);
  const Graph graph = renumbered(complete, identity(complete.size()));
  const Colouring found = colour_free_vertices(graph.view(), workers);
  CHECK(found.count == size);
  CHECK(found.colours == serial_colours(complete));
}

TEST_CASE("a chain against the order has the colours of the serial greedy colouring, with any number of threads") {
  // Short enough for no round at all, and long enough for several blocks of them.
  for (const std::int32_t length : {100, 5000, 20000}) {
    CAPTURE(length);
    const Mesh mesh = hostile_meshes::chain(length);
    const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
    const Graph graph = renumbered(rings, identity(rings.size()));
    // The last one in the row comes first, and so on: two colours in turn.
    for (const int threads : {1, 3}) {
      Workers workers(threads);
      const Colouring found = colour_free_vertices(graph.view(), workers);
      CHECK(found.count == 2);
      CHECK(found.colours == serial_colours(rings));
    }
  }
}

TEST_CASE("the serial colouring goes on where others have left off") {
  const Mesh mesh = test_meshes::jittered_grid(20, 20, 0.3, 1);
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  const Graph graph = renumbered(rings, identity(rings.size()));
  const std::vector<std::int32_t> expected = serial_colours(rings);
  std::vector<std::int32_t> order = identity(rings.size());
  std::ranges::sort(order, &trismooth::coloured_before);
  for (const std::size_t done : {0, 100, 399, 400}) {
    std::vector<std::int32_t> colours(rings.size(), -1);
    for (const std::int32_t v : std::span(order).first(done)) {
      colours[v] = expected[v];
    }
    trismooth::colour_the_rest(graph.view(), colours);
    CHECK(colours == expected);
  }
}

TEST_CASE("nothing free needs no colour") {
  Workers workers(2);
  CHECK(colour_free_vertices({}, workers).count == 0);
  const Graph graph = renumbered(naive::Rings(3), identity(3));
  const Colouring found = colour_free_vertices(graph.view(), workers);
  CHECK(found.count == 0);
  CHECK(found.colours == std::vector<std::int32_t>(3, -1));
}
