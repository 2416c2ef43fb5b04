// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/uploaded_rings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/memory_need.h"

namespace trismooth::cuda {

void require_room_for(const OneRings& rings, const SmoothingOptions& options) {
  const MeshSize size{rings.vertex_count(), rings.vertex_count(), std::ssize(rings.neighbours),
                      !rings.opposites.empty()};
  require_memory(memory_need(size, options) + static_cast<std::size_t>(size.vertices) * sizeof(Point2<double>));
}

void require_quadrilaterals(const SmoothingOptions& options) {
  if (options.execution != Execution::resident) {
    throw std::invalid_argument("execution '" + std::string(to_string(options.execution)) +
                                "' smooths triangles alone: quadrilaterals by execution 'resident'");
  }
}

DeviceRings uploaded(HostCopier& copier, const OneRings& rings) {
  constexpr std::int64_t grain = 32768;
  BulkVector<std::uint32_t> offsets(rings.offsets.size());
  copier.workers().for_blocks(std::ssize(offsets), grain, [&](std::int64_t begin, std::int64_t end) {
    std::transform(rings.offsets.begin() + begin, rings.offsets.begin() + end, offsets.begin() + begin,
                   [](std::int64_t offset) { return static_cast<std::uint32_t>(offset); });
  });
  return {copier.uploaded(std::span<const std::uint32_t>(offsets)), copier.uploaded(std::span(rings.neighbours)),
          copier.uploaded(std::span(rings.opposites))};
}

}  // namespace trismooth::cuda
