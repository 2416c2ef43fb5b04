#include "trismooth/smoothing/rings/colouring.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "trismooth/base/splitmix64.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t colouring_grain = 4096;
constexpr std::int32_t uncoloured = -1;
constexpr std::int32_t done = -1;

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
std::int32_t colour_of(std::int32_t vertex, const RingView& rings, std::span<std::int32_t> colours) {
  SmallestFree free;
  for (const std::int32_t neighbour : rings[vertex]) {
    if (rings.is_free(neighbour) && coloured_before(rings.input(neighbour), rings.input(vertex))) {
      const std::int32_t colour = std::atomic_ref(colours[neighbour]).load(std::memory_order_relaxed);
      if (colour == uncoloured) {
        return uncoloured;
      }
      free.take(colour);
    }
  }
  return free.value();
}

struct Waiting {
  std::uint64_t rank;  ///< in the order of the colouring
  std::int32_t vertex;
};

}  // namespace

void colour_the_rest(const RingView& rings, std::span<std::int32_t> colours) {
  std::vector<Waiting> waiting;
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (colours[v] == uncoloured && rings.is_free(v)) {
      waiting.push_back({splitmix64(static_cast<std::uint64_t>(rings.input(v))), v});
    }
  }
  std::ranges::sort(waiting, {}, &Waiting::rank);
  for (const Waiting& next : waiting) {
    colours[next.vertex] = colour_of(next.vertex, rings, colours);
  }
}

Colouring colour_free_vertices(const RingView& rings, Workers& workers) {
  Colouring colouring;
  colouring.colours.assign(static_cast<std::size_t>(rings.size()), uncoloured);
  std::vector<std::int32_t> waiting;
  waiting.reserve(static_cast<std::size_t>(rings.size()));
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (rings.is_free(v)) {
      waiting.push_back(v);
    }
  }
  // A round of few vertices is the work of one thread, which does better without rounds; and a round that colours few
  // of those that wait for it is one of many, where a chain of vertices runs against the order.
  constexpr std::size_t least_share = 16;
  std::size_t coloured = waiting.size();
  while (std::ssize(waiting) > colouring_grain && coloured >= waiting.size() / least_share) {
    workers.for_blocks(static_cast<std::int64_t>(waiting.size()), colouring_grain,
                       [&](std::int64_t begin, std::int64_t end) {
                         for (std::int64_t i = begin; i < end; ++i) {
                           const std::int32_t colour = colour_of(waiting[i], rings, colouring.colours);
                           if (colour != uncoloured) {
                             std::atomic_ref(colouring.colours[waiting[i]]).store(colour, std::memory_order_relaxed);
                             waiting[i] = done;
                           }
                         }
                       });
    coloured = std::erase(waiting, done);
  }
  if (!waiting.empty()) {
    colour_the_rest(rings, colouring.colours);
  }
  for (const std::int32_t colour : colouring.colours) {
    colouring.count = std::max(colouring.count, colour + 1);
  }
  return colouring;
}

}  // namespace trismooth
