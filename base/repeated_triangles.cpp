#include "trismooth/base/repeated_triangles.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <tuple>

#include "trismooth/base/bulk_memory.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/splitmix64.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t triangle_grain = 16384;

Triangle sorted(Triangle corners) {
  std::ranges::sort(corners);
  return corners;
}

/// The bits of the triangles of which a vertex is the lowest corner.
struct MetAtVertex {
  std::uint64_t once = 0;
  std::uint64_t again = 0;
};

/// The same for copies of a triangle.
std::uint64_t bit_of(const Triangle& ascending) {
  const std::uint64_t others =
      static_cast<std::uint64_t>(ascending[1]) << 32U | static_cast<std::uint32_t>(ascending[2]);
  return std::uint64_t{1} << (splitmix64(others) & 63U);
}

/// The triangles that share lowest corner and bit with another one: all copies, their firsts, and few others.
BulkVector<std::int32_t> find_suspects(std::span<const Triangle> triangles, std::size_t vertex_count,
                                       Workers& workers) {
  std::vector<MetAtVertex> met(vertex_count);
  workers.for_blocks(std::ssize(triangles), triangle_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      const Triangle corners = sorted(triangles[static_cast<std::size_t>(t)]);
      MetAtVertex& here = met[static_cast<std::size_t>(corners[0])];
      const std::uint64_t bit = bit_of(corners);
      if ((std::atomic_ref(here.once).fetch_or(bit, std::memory_order_relaxed) & bit) != 0) {
        std::atomic_ref(here.again).fetch_or(bit, std::memory_order_relaxed);
      }
    }
  });
  return numbers_of(
      std::ssize(triangles),
      [&](std::int64_t t) {
        const Triangle corners = sorted(triangles[static_cast<std::size_t>(t)]);
        const std::uint64_t again = met[static_cast<std::size_t>(corners[0])].again;
        return again != 0 && (again & bit_of(corners)) != 0;
      },
      workers);
}

/// A triangle that may be there more than once.
struct Suspect {
  Triangle corners;  ///< ascending
  std::int32_t triangle;

  bool operator<(const Suspect& other) const {
    return std::tie(corners, triangle) < std::tie(other.corners, other.triangle);
  }
};

}  // namespace

std::vector<RepeatedTriangle> find_repeated_triangles(std::span<const Triangle> triangles, std::size_t vertex_count,
                                                      Workers& workers) {
  std::vector<Suspect> suspects;
  for (const std::int32_t t : find_suspects(triangles, vertex_count, workers)) {
    suspects.push_back({sorted(triangles[static_cast<std::size_t>(t)]), t});
  }
  std::ranges::sort(suspects, std::less<>{});
  std::vector<RepeatedTriangle> repeated;
  for (std::size_t i = 1, first = 0; i < suspects.size(); ++i) {
    if (suspects[i].corners == suspects[first].corners) {
      repeated.push_back({suspects[i].triangle, suspects[first].triangle});
    } else {
      first = i;
    }
  }
  std::ranges::sort(repeated, {}, &RepeatedTriangle::triangle);
  return repeated;
}

}  // namespace trismooth
