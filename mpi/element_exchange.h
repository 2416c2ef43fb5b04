// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/mpi/ascending_ids.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/local_mesh.h"

namespace trismooth::mpi {

/// The ids of an element's corners; where it is listed as MixedElement, no_corner is the last one of a triangle.
template <class Corners>
using CornerIds = std::array<std::int64_t, std::tuple_size_v<Corners>>;

/// An element that another rank has sent.
template <class Corners>
struct ReceivedElement {
  std::int64_t id;
  CornerIds<Corners> vertices;
  std::int32_t region;
  std::int32_t source;  ///< the rank
};

/// A vertex and the rank that owns it.
struct OwnedId {
  std::int64_t id;
  std::int32_t owner;

  auto operator<=>(const OwnedId&) const = default;
};

/// Sorts them, and leaves each there once. Local.
void sort_uniquely(BulkVector<OwnedId>& vertices);

/// What stands for the i-th element that was received, where those of the caller have their numbers. Local.
constexpr std::int32_t received_place(std::size_t i) {
  return -1 - static_cast<std::int32_t>(i);
}
/// Which of the received elements a received_place() stands for. Local.
constexpr std::size_t received_number(std::int32_t place) {
  return static_cast<std::size_t>(-1 - place);
}

/// All elements around a rank's own vertices, in the order of their ids.
template <class Corners>
struct ElementsAround {
  BulkVector<std::int32_t> places;  ///< the caller's number of each, or received_place()
  AscendingIds ids;
  BulkVector<ReceivedElement<Corners>> received;
  BulkVector<OwnedId> foreign;  ///< the corners of received ones that other ranks own
};

/// Sends the elements of all ranks to the owners of their corners. `elements`: those of `mesh`, whose copies are left
/// out, of one type on all ranks: Triangle, or MixedElement. `has_ids`: they have ids, on all ranks; else they are
/// numbered rank by rank. `regions`: one an element, or none. `owners`: the rank that owns each local vertex.
/// Collective. Throws std::invalid_argument on all ranks for an id that is there twice. Complexity: linear in what the
/// rank has and receives, n log n where ids do not ascend.
template <class Corners>
ElementsAround<Corners> exchange_elements(const LocalMesh& mesh, std::span<const Corners> elements, bool has_ids,
                                          std::span<const std::int32_t> regions, std::span<const std::int32_t> owners,
                                          const Communicator& ranks);

}  // namespace trismooth::mpi
