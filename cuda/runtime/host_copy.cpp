// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/host_copy.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 21U;
constexpr std::size_t slot_count = 3;  ///< one is filled, one travels, one waits
/// Below this CUDA's own way takes no longer.
constexpr std::size_t least_bytes = std::size_t{1} << 20U;

/// The page-locked memory of this process: getting it takes longer than most copies. Never given back, since CUDA may
/// end before we do.
struct Stage {
  std::mutex mutex;
  std::byte* memory = nullptr;
};

Stage& the_stage() {
  static Stage stage;
  return stage;
}

/// The stage for one copy, unless somebody else has it, or there is no such memory.
class Slots {
 public:
  Slots() : lock_(the_stage().mutex, std::try_to_lock) {
    if (!lock_.owns_lock()) {
      return;
    }
    std::byte*& memory = the_stage().memory;
    if (memory == nullptr && cudaHostAlloc(reinterpret_cast<void**>(&memory), slot_count * piece_bytes,
                                           cudaHostAllocPortable) != cudaSuccess) {
      cudaGetLastError();
      return;
    }
    memory_ = memory;
    for (cudaEvent_t& event : events_) {
      TRISMOOTH_CUDA_CHECK(cudaEventCreateWithFlags(&event, cudaEventDisableTiming));
    }
  }
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;
  ~Slots() {
    for (cudaEvent_t event : events_) {
      if (event != nullptr) {
        // Where a copy was given up, its pieces are still on their way.
        cudaEventSynchronize(event);
        cudaEventDestroy(event);
      }
    }
  }

  bool usable() const { return memory_ != nullptr; }
  std::byte* at(std::size_t piece) const { return memory_ + piece % slot_count * piece_bytes; }
  /// The piece's copy is what was queued last.
  void queued(std::size_t piece, cudaStream_t stream) {
    TRISMOOTH_CUDA_CHECK(cudaEventRecord(events_[piece % slot_count], stream));
  }
  /// Until the copy queued last in the piece's slot is done; at once where there was none.
  void wait(std::size_t piece) const { TRISMOOTH_CUDA_CHECK(cudaEventSynchronize(events_[piece % slot_count])); }

 private:
  std::unique_lock<std::mutex> lock_;
  std::byte* memory_ = nullptr;
  std::array<cudaEvent_t, slot_count> events_{};
};

/// Waits in the end for all that is queued, also where that has failed.
class Arrival {
 public:
  explicit Arrival(cudaStream_t stream) : stream_(stream) {}
  Arrival(const Arrival&) = delete;
  Arrival& operator=(const Arrival&) = delete;
  ~Arrival() { cudaStreamSynchronize(stream_); }

 private:
  cudaStream_t stream_;
};

bool is_pageable(const void* memory) {
  cudaPointerAttributes attributes{};
  TRISMOOTH_CUDA_CHECK(cudaPointerGetAttributes(&attributes, memory));
  return attributes.type == cudaMemoryTypeUnregistered;
}

/// Calls copy(piece, offset, size) for each piece of an array, in order.
template <class Copy>
void for_pieces(std::size_t bytes, const Copy& copy) {
  for (std::size_t piece = 0; piece * piece_bytes < bytes; ++piece) {
    const std::size_t offset = piece * piece_bytes;
    copy(piece, offset, std::min(piece_bytes, bytes - offset));
  }
}

}  // namespace

void HostCopier::upload(void* to, const void* from, std::size_t bytes) {
  if (bytes == 0) {
    return;
  }
  if (bytes >= least_bytes && is_pageable(from)) {
    if (Slots slots; slots.usable()) {
      for_pieces(bytes, [&](std::size_t piece, std::size_t offset, std::size_t size) {
        slots.wait(piece);
        copy_by_all(slots.at(piece), static_cast<const std::byte*>(from) + offset, size, workers_);
        TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(static_cast<std::byte*>(to) + offset, slots.at(piece), size,
                                             cudaMemcpyHostToDevice, context_.stream()));
        slots.queued(piece, context_.stream());
      });
      return;
    }
  }
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, context_.stream()));
}

bool HostCopier::download_through_slots(Overwriting& target, const std::byte* from) {
  Slots slots;
  if (!slots.usable()) {
    return false;
  }
  const std::size_t bytes = target.memory().size();
  const auto empty = [&](std::size_t piece) {
    slots.wait(piece);
    target.write(slots.at(piece), std::min(piece_bytes, bytes - piece * piece_bytes));
  };
  std::size_t emptied = 0;
  std::size_t filled = 0;
  for_pieces(bytes, [&](std::size_t piece, std::size_t offset, std::size_t size) {
    if (piece - emptied == slot_count) {
      empty(emptied++);
    }
    TRISMOOTH_CUDA_CHECK(
        cudaMemcpyAsync(slots.at(piece), from + offset, size, cudaMemcpyDeviceToHost, context_.stream()));
    slots.queued(piece, context_.stream());
    ++filled;
  });
  while (emptied < filled) {
    empty(emptied++);
  }
  return true;
}

void HostCopier::download(Overwriting& target, const void* from) {
  const std::span<std::byte> memory = target.memory();
  const auto* const source = static_cast<const std::byte*>(from);
  if (memory.empty()) {
    return;
  }
  const bool goes_through_slots = memory.size() >= least_bytes && is_pageable(memory.data());
  if (!goes_through_slots || !download_through_slots(target, source)) {
    // Pieces travel while what the next one will overwrite is kept.
    const Arrival arrival(context_.stream());
    for_pieces(memory.size(), [&](std::size_t /*piece*/, std::size_t offset, std::size_t size) {
      target.give_away(size);
      TRISMOOTH_CUDA_CHECK(
          cudaMemcpyAsync(memory.data() + offset, source + offset, size, cudaMemcpyDeviceToHost, context_.stream()));
    });
    context_.synchronize();
  }
  target.done();
}

}  // namespace trismooth::cuda
