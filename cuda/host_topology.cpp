// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/host_topology.h"

#include <cstddef>
#include <span>
#include <utility>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/uploaded_rings.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/layers/layers.h"
#include "trismooth/smoothing/rings/near_lines.h"

namespace trismooth::cuda {

namespace {

/// A copy of the caller's array on the device; null: none.
template <class T>
std::vector<T> downloaded(const Context& context, const T* array, std::size_t count) {
  return download(context, array, array == nullptr ? 0 : count);
}

Components uploaded(HostCopier& copier, const TriangleComponents& found) {
  constexpr std::int64_t grain = 32768;
  BulkVector<std::uint32_t> words(found.parity.size());
  copier.workers().for_blocks(std::ssize(words), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto e = static_cast<std::size_t>(begin); e < static_cast<std::size_t>(end); ++e) {
      words[e] = static_cast<std::uint32_t>(found.component[e]) << 1U | found.parity[e];
    }
  });
  return {copier.uploaded(std::span<const std::uint32_t>(words)), found.components};
}

}  // namespace

HostTopology::HostTopology(Context& context, std::int32_t vertex_count, const std::int32_t* elements,
                           std::vector<MixedElement> on_host, const DeviceConstraints& constraints, int threads)
    : ListTopology(context, {elements, static_cast<std::int32_t>(on_host.size())}),
      copier_(context, threads),
      on_host_(std::move(on_host)),
      quadrilaterals_(ElementList(on_host_).count_quadrilaterals()),
      connectivity_(vertex_count, std::span<const MixedElement>(on_host_), copier_.workers()) {
  const auto vertices = static_cast<std::size_t>(vertex_count);
  const auto fixed = downloaded(context, constraints.fixed, vertices);
  const auto other_cells = downloaded(context, constraints.other_cells, vertices);
  const auto fixed_ids =
      downloaded(context, constraints.fixed_ids, static_cast<std::size_t>(constraints.fixed_id_count));
  const auto regions = downloaded(context, constraints.regions, on_host_.size());
  fixed_on_host_ = connectivity_.fixed_vertices(
      std::span<const MixedElement>(on_host_),
      {.fixed = fixed, .fixed_ids = fixed_ids, .other_cells = other_cells, .regions = regions}, copier_.workers());
  fixed_ = copier_.uploaded(std::span<const std::uint8_t>(fixed_on_host_));
  components_ = uploaded(copier_, connectivity_.components());
}

NearLines HostTopology::near_lines(const std::int32_t* regions) {
  return trismooth::near_lines(on_host_, fixed_on_host_, downloaded(*context_, regions, on_host_.size()),
                               copier_.workers());
}

LayersResult HostTopology::hold_layers(const Point2<double>* local_points, Layers layers, bool slides,
                                       std::vector<std::int32_t>& held) {
  held.clear();
  if (layers == Layers::smooth) {
    return {};
  }
  const std::vector<std::uint8_t> before = fixed_on_host_;
  const LayersResult found =
      trismooth::hold_layers(download(*context_, local_points, before.size()), std::span<const MixedElement>(on_host_),
                             downloaded_reversed(), layers, slides, fixed_on_host_, copier_.workers());
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (fixed_on_host_[v] != before[v]) {
      held.push_back(static_cast<std::int32_t>(v));
    }
  }
  copier_.upload(fixed_, std::span<const std::uint8_t>(fixed_on_host_));
  return found;
}

DeviceRings HostTopology::rings() {
  return cuda::uploaded(copier_, connectivity_.one_rings(std::span<const MixedElement>(on_host_), downloaded_reversed(),
                                                         fixed_on_host_, copier_.workers()));
}

std::string_view HostTopology::note() const {
  return host_found_quadrilaterals;
}

std::vector<std::uint8_t> HostTopology::downloaded_reversed() const {
  return download(*context_, reversed(), on_host_.size());
}

}  // namespace trismooth::cuda
