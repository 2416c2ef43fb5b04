// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/local_mesh_checks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"

namespace trismooth::mpi {

namespace {

void require_length(std::size_t length, std::size_t expected, const char* what, const char* of) {
  if (length != expected) {
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(length) +
                                " entries, expected one for each of " + std::to_string(expected) + " " + of);
  }
}

void check_ids(std::span<const std::int64_t> ids) {
  const auto require_not_negative = [&](std::size_t v) {
    if (ids[v] < 0) {
      throw std::invalid_argument("vertex_ids: that of local vertex " + std::to_string(v) + " is " +
                                  std::to_string(ids[v]) + ", and must not be negative");
    }
  };
  if (std::ranges::is_sorted(ids, std::less_equal<>())) {
    if (!ids.empty()) {
      require_not_negative(0);
    }
    return;
  }
  std::vector<std::pair<std::int64_t, std::size_t>> order;
  for (std::size_t v = 0; v < ids.size(); ++v) {
    require_not_negative(v);
    order.emplace_back(ids[v], v);
  }
  std::ranges::sort(order);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first == order[i - 1].first) {
      throw std::invalid_argument("vertex_ids: local vertices " + std::to_string(order[i - 1].second) + " and " +
                                  std::to_string(order[i].second) + " have the same id " +
                                  std::to_string(order[i].first));
    }
  }
}

void check_triangle_ids(std::span<const std::int64_t> ids) {
  // Votes for orientations have one bit more.
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max() / 4;
  for (std::size_t t = 0; t < ids.size(); ++t) {
    if (ids[t] < 0 || ids[t] > largest) {
      throw std::invalid_argument("triangle_ids: that of local triangle " + std::to_string(t) + " is " +
                                  std::to_string(ids[t]) + ", and must be from 0 to " + std::to_string(largest));
    }
  }
}

}  // namespace

void check_local_mesh(const LocalMesh& mesh, const ElementList& elements, const Constraints& constraints, int ranks) {
  const auto element_count = static_cast<std::int64_t>(elements.size());
  check_mesh_size(std::ssize(mesh.vertex_ids), element_count, elements.are_triangles() ? 3 : 4);
  const auto vertices = static_cast<std::int32_t>(mesh.vertex_ids.size());
  elements.visit([&](const auto& listed) { check_triangles(vertices, listed); });
  check_constraints(constraints, vertices, element_count);
  check_ids(mesh.vertex_ids);
  if (!mesh.owners.empty()) {
    require_length(mesh.owners.size(), mesh.vertex_ids.size(), "owners", "local vertices");
    for (std::size_t v = 0; v < mesh.owners.size(); ++v) {
      if (mesh.owners[v] < 0 || mesh.owners[v] >= ranks) {
        throw std::invalid_argument("owners: that of local vertex " + std::to_string(v) + " is " +
                                    std::to_string(mesh.owners[v]) + ", and the ranks are 0 to " +
                                    std::to_string(ranks - 1));
      }
    }
  }
  if (!mesh.ghost_triangles.empty()) {
    require_length(mesh.ghost_triangles.size(), elements.size(), "ghost_triangles", "local triangles");
  }
  if (!mesh.triangle_ids.empty()) {
    require_length(mesh.triangle_ids.size(), elements.size(), "triangle_ids", "local triangles");
    check_triangle_ids(mesh.triangle_ids);
  }
}

}  // namespace trismooth::mpi
