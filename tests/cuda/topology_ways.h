// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "trismooth/base/errors.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/cuda/topology/find_rings.h"
#include "trismooth/cuda/topology/neighbour_search.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

#include "catch.h"
#include "support/test_meshes.h"

/// The ways to find the topology of a mesh, held to the host's.
namespace topology_ways {

using trismooth::cuda::NeighbourSearch;

inline constexpr auto both_ways = {NeighbourSearch::parallel, NeighbourSearch::one_thread};

inline trismooth::MeshRings find_on_host(const test_meshes::Mesh& mesh, const trismooth::Constraints& constraints) {
  trismooth::Workers workers(0);
  return trismooth::find_mesh_rings(mesh.points, mesh.triangles, constraints, workers);
}

/// What a call throws: the message, and whether it is a MeshError (true) or a std::invalid_argument (false).
struct Thrown {
  bool is_mesh_error;
  std::string message;

  friend bool operator==(const Thrown&, const Thrown&) = default;
};

template <class Call>
std::optional<Thrown> thrown_by(const Call& call) {
  try {
    call();
  } catch (const trismooth::MeshError& error) {
    return Thrown{true, error.what()};
  } catch (const std::invalid_argument& error) {
    return Thrown{false, error.what()};
  }
  return std::nullopt;
}

inline void require_same_error(const test_meshes::Mesh& mesh, const trismooth::Constraints& constraints = {}) {
  const auto expected = thrown_by([&] { find_on_host(mesh, constraints); });
  REQUIRE(expected);
  for (const NeighbourSearch way : both_ways) {
    CAPTURE(static_cast<int>(way));
    const auto found =
        thrown_by([&] { trismooth::cuda::find_rings_on_device(mesh.points, mesh.triangles, constraints, way); });
    REQUIRE(found);
    CHECK(found->is_mesh_error == expected->is_mesh_error);
    CHECK(found->message == expected->message);
  }
}

}  // namespace topology_ways
