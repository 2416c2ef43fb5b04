// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/halo/halo.h"

#include <utility>

namespace trismooth {

Halo::Halo(const MeshPart& part, const PackedRings& rings)
    : part_(part), messages_(part.messages()), first_fixed_(rings.first_fixed()) {
  std::vector<std::int32_t> packed(static_cast<std::size_t>(rings.vertex_count()));
  for (std::int32_t v = 0; v < rings.vertex_count(); ++v) {
    packed[static_cast<std::size_t>(rings.input_index[v])] = v;
  }
  const bool has_colours = rings.colours > 0;
  of_colours_.resize(static_cast<std::size_t>(has_colours ? part.colour_count : 1));
  const auto add = [&](const std::vector<std::int32_t>& vertices, VertexLists VertexExchange::*direction) {
    const auto lists = [&](VertexExchange& exchange) -> VertexLists& { return exchange.*direction; };
    for (const std::int32_t v : vertices) {
      const std::int32_t number = packed[static_cast<std::size_t>(v)];
      const std::int32_t colour = part.colours[static_cast<std::size_t>(v)];
      lists(of_all_).vertices.push_back(number);
      lists(colour == no_colour ? fixed_to_ghosts_ : of_colours_[static_cast<std::size_t>(has_colours ? colour : 0)])
          .vertices.push_back(number);
    }
    lists(of_all_).end();
    lists(fixed_to_ghosts_).end();
    for (VertexExchange& exchange : of_colours_) {
      lists(exchange).end();
    }
  };
  for (const MeshPart::Neighbour& neighbour : part.neighbours) {
    add(neighbour.sends, &VertexExchange::sends);
    add(neighbour.receives, &VertexExchange::receives);
  }
  fixed_to_owners_ = {fixed_to_ghosts_.receives, fixed_to_ghosts_.sends};
  std::vector<std::pair<std::int32_t, std::int32_t>> around;
  for (std::int32_t v = 0; v < rings.free_count(); ++v) {
    rings.view().for_vertices_around(v, [&](std::int32_t other) {
      // (Fixed ghosts never move.)
      if (other >= rings.free_count() && other < rings.first_fixed()) {
        around.emplace_back(other, v);
      }
    });
  }
  around_ghosts_ = NumberLists(rings.free_count(), rings.vertex_count(), around);
}

bool any_part(const Halo* halo, bool own) {
  return sum_of_parts(halo, own ? 1 : 0) > 0;
}

double least_of_parts(const Halo* halo, double own) {
  if (halo == nullptr) {
    return own;
  }
  PartSums sums;
  sums.largest = {-own, -own};
  halo->messenger().join(sums);
  return -sums.largest[0];
}

std::int64_t sum_of_parts(const Halo* halo, std::int64_t own) {
  if (halo == nullptr) {
    return own;
  }
  PartSums sums;
  sums.sums[0] = own;
  halo->messenger().join(sums);
  return sums.sums[0];
}

}  // namespace trismooth
