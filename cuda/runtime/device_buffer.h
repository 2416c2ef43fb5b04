// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/context.h"

namespace trismooth::cuda {

/// Owns an array on the device. Move-only. All work on it is queued on the stream of its context.
template <class T>
class DeviceBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  DeviceBuffer() = default;
  /// `size` elements, not initialised. Throws DeviceError where the device has too little memory.
  DeviceBuffer(Context& context, std::size_t size)
      : context_(&context), data_(static_cast<T*>(context.allocate(size * sizeof(T)))), size_(size) {}
  DeviceBuffer(Context& context, std::span<const T> values) : DeviceBuffer(context, values.size()) { upload(values); }
  DeviceBuffer(DeviceBuffer&& other) noexcept
      : context_(other.context_), data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    other.reset();
    return *this;
  }
  ~DeviceBuffer() { reset(); }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }

  /// Gives the memory back.
  void reset() noexcept {
    if (data_ != nullptr) {
      context_->free(data_, size_ * sizeof(T));
    }
    data_ = nullptr;
    size_ = 0;
  }
  /// Sets every byte.
  void fill_bytes(int byte) {
    if (size_ > 0) {
      TRISMOOTH_CUDA_CHECK(cudaMemsetAsync(data_, byte, size_ * sizeof(T), context_->stream()));
    }
  }
  /// Copies from the host. `values` may be changed as soon as this returns if it is pageable memory.
  void upload(std::span<const T> values) {
    if (!values.empty()) {
      TRISMOOTH_CUDA_CHECK(
          cudaMemcpyAsync(data_, values.data(), values.size_bytes(), cudaMemcpyHostToDevice, context_->stream()));
    }
  }
  /// Copies the first values to the host and waits for them.
  void download(std::span<T> values) const {
    if (!values.empty()) {
      TRISMOOTH_CUDA_CHECK(
          cudaMemcpyAsync(values.data(), data_, values.size_bytes(), cudaMemcpyDeviceToHost, context_->stream()));
      context_->synchronize();
    }
  }

 private:
  Context* context_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace trismooth::cuda
