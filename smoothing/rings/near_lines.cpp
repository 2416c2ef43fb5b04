// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/near_lines.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/quality/element.h"

namespace trismooth {

NearLines near_lines(const ElementList& elements, std::span<const std::uint8_t> fixed,
                     std::span<const std::int32_t> regions, Workers& workers) {
  const auto reasons = [&](std::int32_t v) { return fixed[v]; };
  const auto is_near = [&](std::int32_t v) { return is_held_by_lines(reasons(v)); };
  const BulkVector<std::int32_t> numbers = elements.visit([&](const auto& listed) {
    return numbers_of(
        std::ssize(listed), [&](std::int64_t e) { return std::ranges::any_of(corners_of(listed[e]), is_near); },
        workers);
  });
  const BulkVector<std::int32_t> others = numbers_of(
      std::ssize(fixed), [&](std::int64_t v) { return is_held_otherwise(reasons(static_cast<std::int32_t>(v))); },
      workers);
  NearLines near{{}, {others.begin(), others.end()}};
  near.elements.reserve(numbers.size());
  for (const std::int32_t number : numbers) {
    const auto e = static_cast<std::size_t>(number);
    NearElement element{number, {no_corner, no_corner, no_corner, no_corner}, {}, regions.empty() ? 0 : regions[e]};
    std::ranges::copy(elements[e], element.corners.begin());
    std::ranges::transform(elements[e], element.reasons.begin(), reasons);
    near.elements.push_back(element);
  }
  return near;
}

}  // namespace trismooth
