// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/smoothing/parts/mesh_part.h"

namespace trismooth::mpi {

/// Brings ghosts what their owners have, in the numbers of a part.
class GhostValues {
 public:
  /// `part` may go afterwards, but for its messenger. Local.
  explicit GhostValues(const MeshPart& part) : messages_(part.messages()), exchange_(part.ghost_exchange()) {}

  /// Gives ghosts the values of their owners. `values`: one a vertex of the part. Collective.
  template <class V>
  void update(std::span<V> values) {
    messages_.start(exchange_, std::span<const V>(values));
    messages_.finish<V>(exchange_,
                        [&](std::int32_t v, const V& value) { values[static_cast<std::size_t>(v)] = value; });
  }

 private:
  VertexMessages messages_;
  VertexExchange exchange_;
};

}  // namespace trismooth::mpi
