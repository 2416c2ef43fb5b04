#include "trismooth/smoothing/colouring.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "trismooth/smoothing/splitmix64.h"

namespace trismooth {

namespace {

constexpr std::int64_t grain = 4096;
constexpr std::int32_t uncoloured = -1;

/// The smallest number from 0 that `taken` numbers do not hold.
class SmallestFree {
 public:
  void take(std::int32_t colour) {
    if (colour < 64) {
      low_ |= std::uint64_t{1} << static_cast<unsigned>(colour);
    } else {
      high_.push_back(colour);
    }
  }
  std::int32_t value() {
    if (~low_ != 0) {
      return std::countr_one(low_);
    }
    std::ranges::sort(high_);
    std::int32_t colour = 64;
    for (const std::int32_t taken : high_) {
      colour += taken == colour ? 1 : 0;
    }
    return colour;
  }

 private:
  std::uint64_t low_ = 0;
  std::vector<std::int32_t> high_;
};

/// The colour of `vertex`, or uncoloured while a neighbour that comes before it has none.
std::int32_t colour_of(std::int32_t vertex, const OneRings& rings, std::vector<std::int32_t>& colours) {
  SmallestFree free;
  for (const std::int32_t neighbour : rings[vertex]) {
    if (rings.is_free(neighbour) && coloured_before(neighbour, vertex)) {
      const std::int32_t colour = std::atomic_ref(colours[neighbour]).load(std::memory_order_relaxed);
      if (colour == uncoloured) {
        return uncoloured;
      }
      free.take(colour);
    }
  }
  return free.value();
}

}  // namespace

Colouring colour_free_vertices(const OneRings& rings, std::span<const std::int32_t> visit_order, Workers& workers) {
  Colouring colouring;
  colouring.colours.assign(static_cast<std::size_t>(rings.vertex_count()), uncoloured);
  std::vector<std::int32_t> waiting(visit_order.begin(), visit_order.end());
  std::vector<std::int32_t> next(waiting.size());
  while (!waiting.empty()) {
    ++colouring.rounds;
    workers.for_blocks(static_cast<std::int64_t>(waiting.size()), grain, [&](std::int64_t begin, std::int64_t end) {
      // A block keeps its vertices together and in their order, at its own place: then they are packed.
      std::int64_t kept = begin;
      for (std::int64_t i = begin; i < end; ++i) {
        const std::int32_t vertex = waiting[i];
        const std::int32_t colour = colour_of(vertex, rings, colouring.colours);
        if (colour == uncoloured) {
          next[kept++] = vertex;
        } else {
          std::atomic_ref(colouring.colours[vertex]).store(colour, std::memory_order_relaxed);
        }
      }
      std::fill(next.begin() + kept, next.begin() + end, uncoloured);
    });
    std::erase(next, uncoloured);
    waiting.swap(next);
    next.resize(waiting.size());
  }
  for (const std::int32_t colour : colouring.colours) {
    colouring.count = std::max(colouring.count, colour + 1);
  }
  return colouring;
}

}  // namespace trismooth
