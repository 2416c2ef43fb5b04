// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/smoothing/parts/mesh_part.h"

namespace trismooth::cuda {

/// Brings what is in the memory of one part's device into that of others.
class GhostTransport {
 public:
  GhostTransport() = default;
  GhostTransport(const GhostTransport&) = delete;
  GhostTransport& operator=(const GhostTransport&) = delete;
  virtual ~GhostTransport() = default;

  /// What goes to a neighbour, or comes from it; in device memory.
  struct Message {
    int part;
    std::byte* bytes;
    std::size_t size;
  };

  /// Sends what is there when all that is queued on `stream` so far is done, meanwhile what is queued after it runs.
  /// One exchange at a time, on all parts in the same order.
  virtual void start(std::span<const Message> sends, std::span<const Message> receives, cudaStream_t stream) = 0;
  /// What is queued on `stream` from now on finds what has come.
  virtual void finish(cudaStream_t stream) = 0;
};

/// NCCL's where all parts have it and a device of their own each; else, or where TRISMOOTH_GHOSTS=host is in the
/// environment of one of them, by way of the host. Collective over the parts, whose current devices are those that it
/// is for.
std::unique_ptr<GhostTransport> make_ghost_transport(const MeshPart& part);

}  // namespace trismooth::cuda
