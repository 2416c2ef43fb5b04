// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include <cuda_runtime_api.h>

namespace trismooth::cuda {

/// Where the work of one smoother is queued, and how much device memory it holds. The buffers of a smoother refer to
/// it, so it outlives them and stays where it is.
class Context {
 public:
  /// A stream of its own on the current device.
  Context();
  /// The stream of someone else, who keeps it.
  explicit Context(cudaStream_t stream);
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();

  cudaStream_t stream() const { return stream_; }
  /// Waits for everything queued. Throws DeviceError for what failed meanwhile.
  void synchronize() const;

  /// Device memory of `bytes` (0: none) from current_pool(), aligned to 256 bytes. Throws DeviceError that says how
  /// much was asked for and how much is free.
  void* allocate(std::size_t bytes);
  void free(void* memory, std::size_t bytes) noexcept;

  std::size_t bytes_in_use() const { return in_use_; }
  std::size_t peak_bytes() const { return peak_; }

 private:
  cudaStream_t stream_ = nullptr;
  bool owns_stream_ = true;
  cudaMemPool_t pool_;
  std::size_t in_use_ = 0;
  std::size_t peak_ = 0;
};

}  // namespace trismooth::cuda
