// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/colouring.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

#include "trismooth/base/machine/blocks.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/splitmix64.h"

namespace trismooth {

namespace {

constexpr std::int64_t colouring_grain = 4096;
constexpr std::int32_t uncoloured = -1;
constexpr std::int32_t none = -1;
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

/// The order of the colouring, by the leading half of what coloured_before() compares: that is found once for each
/// vertex, not for each of its neighbours and again in every round.
class Ranks {
 public:
  Ranks(const RingView& rings, Workers& workers) : rings_(rings), ranks_(static_cast<std::size_t>(rings.size())) {
    workers.for_blocks(rings.size(), colouring_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        ranks_[v] = rings.is_free(v)
                        ? static_cast<std::uint32_t>(splitmix64(static_cast<std::uint64_t>(rings.input(v))) >> 32U)
                        : last;
      }
    });
  }

  /// Whether `neighbour` is a free vertex that comes before the free vertex `vertex`.
  bool comes_before(std::int32_t neighbour, std::int32_t vertex) const {
    if (neighbour >= rings_.size() || ranks_[neighbour] > ranks_[vertex]) {
      return false;
    }
    return ranks_[neighbour] < ranks_[vertex] ||
           (rings_.is_free(neighbour) && coloured_before(rings_.input(neighbour), rings_.input(vertex)));
  }

 private:
  static constexpr std::uint32_t last = 0xffffffffU;  ///< of those without a ring

  const RingView& rings_;
  BulkVector<std::uint32_t> ranks_;
};

/// The colour of a vertex, or a neighbour that comes before it and has none yet.
struct Attempt {
  std::int32_t colour;
  std::int32_t awaited;
};

template <class ComesBefore>
Attempt colour_of(std::int32_t vertex, const RingView& rings, std::span<std::int32_t> colours,
                  const ComesBefore& comes_before) {
  SmallestFree free;
  std::int32_t awaited = none;
  const auto leave_to = [&](std::int32_t other) {
    if (comes_before(other, vertex)) {
      const std::int32_t colour = std::atomic_ref(colours[other]).load(std::memory_order_relaxed);
      awaited = colour == uncoloured ? other : none;
      if (awaited == none) {
        free.take(colour);
      }
    }
    return awaited == none;
  };
  if (!std::ranges::all_of(rings[vertex], leave_to)) {
    return {uncoloured, awaited};
  }
  if (rings.has_quadrilaterals() && !std::ranges::all_of(rings.mixed(vertex).opposites, [&](std::int32_t opposite) {
        return opposite == no_corner || leave_to(opposite);
      })) {
    return {uncoloured, awaited};
  }
  return {free.value(), none};
}

/// Colours vertices of the range [first, last], which nobody else does, and before each of them those of the range for
/// which it has to wait. A vertex that waits for another one, or for a long chain, is left. Vertices of very many
/// neighbours neither wait here nor are waited for: every time all of their neighbours would be looked at again.
class RangeColouring {
 public:
  RangeColouring(const RingView& rings, const Ranks& ranks, std::span<std::int32_t> colours, std::int32_t first,
                 std::int32_t last)
      : rings_(rings), ranks_(ranks), colours_(colours), first_(first), last_(last) {}

  /// Whether `vertex` has a colour now.
  bool colour(std::int32_t vertex) {
    if (colours_[vertex] != uncoloured) {
      return true;
    }
    chain_[0] = vertex;
    for (std::size_t length = 1; length > 0;) {
      const auto [colour, awaited] = colour_of(chain_[length - 1], rings_, colours_, [&](auto neighbour, auto own) {
        return ranks_.comes_before(neighbour, own);
      });
      if (colour != uncoloured) {
        std::atomic_ref(colours_[chain_[--length]]).store(colour, std::memory_order_relaxed);
      } else if (awaited >= first_ && awaited <= last_ && length < chain_.size() &&
                 has_few_neighbours(chain_[length - 1]) && has_few_neighbours(awaited)) {
        chain_[length++] = awaited;
      } else {
        return false;
      }
    }
    return true;
  }

 private:
  bool has_few_neighbours(std::int32_t vertex) const {
    constexpr std::size_t few = 32;
    return rings_[vertex].size() <= few;
  }

  const RingView& rings_;
  const Ranks& ranks_;
  std::span<std::int32_t> colours_;
  std::int32_t first_;
  std::int32_t last_;
  std::array<std::int32_t, 8> chain_;  ///< each waits for the next one
};

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
    colours[next.vertex] =
        colour_of(next.vertex, rings, colours, [&](std::int32_t neighbour, std::int32_t vertex) {
          return rings.is_free(neighbour) && coloured_before(rings.input(neighbour), rings.input(vertex));
        }).colour;
  }
}

void colour_ready(const RingView& rings, std::span<const std::int64_t> ids, std::span<const std::uint8_t> is_free,
                  std::span<std::int32_t> colours, BulkVector<std::int32_t>& waiting, Workers& workers) {
  // As Ranks: found once for each vertex.
  BulkVector<std::uint32_t> ranks(ids.size());
  workers.for_blocks(std::ssize(ids), colouring_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      ranks[v] = static_cast<std::uint32_t>(splitmix64(static_cast<std::uint64_t>(ids[v])) >> 32U);
    }
  });
  const auto comes_before = [&](std::int32_t neighbour, std::int32_t vertex) {
    return is_free[neighbour] != 0 &&
           (ranks[neighbour] < ranks[vertex] ||
            (ranks[neighbour] == ranks[vertex] && coloured_before(ids[neighbour], ids[vertex])));
  };
  const auto colour_all = [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int32_t colour = colour_of(waiting[i], rings, colours, comes_before).colour;
      if (colour != uncoloured) {
        std::atomic_ref(colours[waiting[i]]).store(colour, std::memory_order_relaxed);
        waiting[i] = done;
      }
    }
  };
  // Rounds, as in colour_free_vertices(), while each colours many.
  constexpr std::size_t least_share = 16;
  for (bool colours_many = true; !waiting.empty();) {
    if (!colours_many) {
      std::ranges::sort(waiting, comes_before);
    }
    const std::size_t before = waiting.size();
    workers.for_blocks(std::ssize(waiting), colours_many ? colouring_grain : std::ssize(waiting), colour_all);
    waiting = numbers_of(
        std::ssize(waiting), [&](std::int64_t i) { return waiting[i] != done; }, workers,
        [&](std::int64_t i) { return waiting[i]; });
    if (!colours_many) {
      return;  // in their order none of them has to be asked twice
    }
    colours_many = before - waiting.size() >= before / least_share && before - waiting.size() > 0;
  }
}

Colouring colour_free_vertices(const RingView& rings, Workers& workers) {
  Colouring colouring;
  BulkVector<std::int32_t>& colours = colouring.colours;
  colours.resize(static_cast<std::size_t>(rings.size()));
  workers.for_blocks(rings.size(), colouring_grain, [&](std::int64_t begin, std::int64_t end) {
    std::fill(colours.begin() + begin, colours.begin() + end, uncoloured);
  });
  BulkVector<std::int32_t> waiting = numbers_of(
      rings.size(), [&](std::int64_t v) { return rings.is_free(static_cast<std::int32_t>(v)); }, workers);
  const Ranks ranks(rings, workers);
  // A round of few vertices is the work of one thread, which does better without rounds; and a round that colours few
  // of those that wait for it is one of many, where a chain of vertices runs against the order.
  constexpr std::size_t least_share = 16;
  std::size_t coloured = waiting.size();
  while (std::ssize(waiting) > colouring_grain && coloured >= waiting.size() / least_share) {
    workers.for_blocks(std::ssize(waiting), colouring_grain, [&](std::int64_t begin, std::int64_t end) {
      // All that wait are listed in their order: those of this range are those of this part.
      RangeColouring range(rings, ranks, colours, waiting[begin], waiting[end - 1]);
      for (std::int64_t i = begin; i < end; ++i) {
        if (range.colour(waiting[i])) {
          waiting[i] = done;
        }
      }
    });
    const std::size_t before = waiting.size();
    waiting = numbers_of(
        std::ssize(waiting), [&](std::int64_t i) { return waiting[i] != done; }, workers,
        [&](std::int64_t i) { return waiting[i]; });
    coloured = before - waiting.size();
  }
  if (!waiting.empty()) {
    colour_the_rest(rings, colours);
  }
  const Blocks blocks(rings.size(), colouring_grain, workers);
  std::vector<std::int32_t> highest(static_cast<std::size_t>(blocks.count()), uncoloured);
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    if (begin < end) {
      highest[block] = *std::max_element(colours.begin() + begin, colours.begin() + end);
    }
  });
  colouring.count = *std::ranges::max_element(highest) + 1;
  return colouring;
}

}  // namespace trismooth
