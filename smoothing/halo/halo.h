// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/number_lists.h"
#include "trismooth/smoothing/parts/mesh_part.h"
#include "trismooth/smoothing/rings/packed_rings.h"

namespace trismooth {

/// The ghosts of a part in packed numbers, and the exchanges that keep them as their owners have them. One exchange at
/// a time. `part` must outlive it.
class Halo {
 public:
  Halo(const MeshPart& part, const PackedRings& rings);

  PartMessenger& messenger() const { return *part_.messenger; }
  const MeshPart& part() const { return part_; }
  /// Own free vertices that have an element with the ghost (any vertex without a ring), opposite corners of
  /// quadrilaterals among them.
  const NumberLists& around_ghosts() const { return around_ghosts_; }

  /// What goes to the neighbours and comes from them of each colour (Form A: of one, which all have).
  std::span<const VertexExchange> of_colours() const { return of_colours_; }

  /// Sends `values`, one for each packed vertex, of own free vertices of a colour (Form A: 0, which all have).
  template <class V>
  void start(std::int32_t colour, std::span<const V> values) {
    messages_.start(of_colours_[static_cast<std::size_t>(colour)], values);
  }
  /// Waits for what the owners have sent of the ghosts of that colour, and calls take(ghost, value) for them.
  template <class V, class Take>
  void finish(std::int32_t colour, const Take& take) {
    messages_.finish<V>(of_colours_[static_cast<std::size_t>(colour)], take);
  }

  /// Brings the values of all ghosts, fixed ones too.
  template <class V>
  void update(std::span<V> values) {
    bring(of_all_, values, 0, [](V& value, const V& owners) { value = owners; });
  }

  /// Joins what the parts have found of fixed vertices that several of them know: join(value, other). `values`: from
  /// PackedRings::first_fixed() on.
  template <class V, class Join>
  void join_fixed(std::span<V> values, const Join& join) {
    bring(fixed_to_owners_, values, first_fixed_, join);
    bring(fixed_to_ghosts_, values, first_fixed_, [](V& value, const V& owners) { value = owners; });
  }

 private:
  template <class V, class Join>
  void bring(const VertexExchange& exchange, std::span<V> values, std::int32_t first, const Join& join) {
    messages_.start(exchange, std::span<const V>(values), first);
    messages_.finish<V>(
        exchange, [&](std::int32_t v, const V& other) { join(values[static_cast<std::size_t>(v - first)], other); });
  }

  const MeshPart& part_;
  VertexMessages messages_;
  NumberLists around_ghosts_;
  std::vector<VertexExchange> of_colours_;
  VertexExchange of_all_;
  VertexExchange fixed_to_ghosts_;
  VertexExchange fixed_to_owners_;
  std::int32_t first_fixed_;
};

/// Whether any part says so. Without a halo there is one part.
bool any_part(const Halo* halo, bool own);
/// The smallest of what the parts have.
double least_of_parts(const Halo* halo, double own);
/// The sum of what they have.
std::int64_t sum_of_parts(const Halo* halo, std::int64_t own);

}  // namespace trismooth
