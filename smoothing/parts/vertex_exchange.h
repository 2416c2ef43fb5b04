// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/smoothing/parts/part_messenger.h"

namespace trismooth {

/// Which vertices go to each neighbour of a part, or come from it: one neighbour after the other.
struct VertexLists {
  std::vector<std::int32_t> vertices;
  std::vector<std::size_t> begins{0};  ///< neighbour i has vertices[begins[i] .. begins[i + 1])

  /// Ends the list of a neighbour.
  void end() { begins.push_back(vertices.size()); }
};

/// An exchange of values, one a vertex, between a part and its neighbours.
struct VertexExchange {
  VertexLists sends;
  VertexLists receives;
};

/// Makes exchanges, one at a time. Owns the memory that messages need.
class VertexMessages {
 public:
  /// `neighbours`: the parts that the lists are of.
  VertexMessages(PartMessenger& messenger, std::vector<int> neighbours)
      : messenger_(messenger), neighbours_(std::move(neighbours)) {}

  /// Sends values[v - first] of the vertices v that are to go.
  template <class V>
  void start(const VertexExchange& exchange, std::span<const V> values, std::int32_t first = 0) {
    static_assert(std::is_trivially_copyable_v<V>);
    out_.resize(sizeof(V) * exchange.sends.vertices.size());
    std::byte* place = out_.data();
    for (const std::int32_t v : exchange.sends.vertices) {
      std::memcpy(place, &values[static_cast<std::size_t>(v - first)], sizeof(V));
      place += sizeof(V);
    }
    in_.resize(sizeof(V) * exchange.receives.vertices.size());
    messenger_.start(messages(exchange.sends, out_, sizeof(V)), messages(exchange.receives, in_, sizeof(V)));
  }

  /// Waits for it, and calls take(vertex, value) for what has come.
  template <class V, class Take>
  void finish(const VertexExchange& exchange, const Take& take) {
    messenger_.finish();
    const std::byte* place = in_.data();
    for (const std::int32_t v : exchange.receives.vertices) {
      V value;
      std::memcpy(&value, place, sizeof(V));
      place += sizeof(V);
      take(v, value);
    }
  }

 private:
  std::vector<PartMessenger::Message> messages(const VertexLists& lists, std::vector<std::byte>& bytes,
                                               std::size_t value_size) const {
    std::vector<PartMessenger::Message> messages;
    for (std::size_t i = 0; i < neighbours_.size(); ++i) {
      const std::size_t begin = value_size * lists.begins[i];
      if (const std::size_t size = value_size * lists.begins[i + 1] - begin; size > 0) {
        messages.push_back({neighbours_[i], std::span(bytes).subspan(begin, size)});
      }
    }
    return messages;
  }

  PartMessenger& messenger_;
  std::vector<int> neighbours_;
  std::vector<std::byte> out_;
  std::vector<std::byte> in_;
};

}  // namespace trismooth
