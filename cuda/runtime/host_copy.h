// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "trismooth/base/machine/overwriting.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// Copies large arrays of the caller to the device and back on a context's stream.
///
/// CUDA copies ordinary (pageable) memory through a small buffer of its own by one thread, at a fraction of what the
/// connection to the device carries. Here all threads fill, or empty, page-locked pieces while the ones before them
/// travel. Memory that the caller has page-locked goes directly.
class HostCopier {
 public:
  /// `threads` as in SmoothingOptions. `context` outlives this.
  HostCopier(Context& context, int threads) : context_(context), workers_(threads) {}

  /// Queues a copy to the device. Ordinary memory has been read when this returns; page-locked memory is read until the
  /// stream has come this far.
  template <class T>
  void upload(DeviceBuffer<T>& to, std::span<const T> from) {
    upload(to.data(), from.data(), from.size_bytes());
  }
  /// A new buffer with these values.
  template <class T>
  DeviceBuffer<T> uploaded(std::span<const T> values) {
    DeviceBuffer<T> buffer(context_, values.size());
    upload(buffer, values);
    return buffer;
  }
  /// Copies the first values of a buffer to the host and waits for them.
  template <class T>
  void download(std::span<T> to, const DeviceBuffer<T>& from) {
    Overwriting target(std::as_writable_bytes(to), nullptr, workers_);
    download(target, from);
  }
  /// Downloads to memory of an owner who has chosen what is to be left where the download breaks off.
  template <class T>
  void download(Overwriting& target, const DeviceBuffer<T>& from) {
    download(target, from.data());
  }

  Workers& workers() { return workers_; }

 private:
  void upload(void* to, const void* from, std::size_t bytes);
  void download(Overwriting& target, const void* from);
  /// Piece by piece through page-locked memory. False where there is none to be had.
  bool download_through_slots(Overwriting& target, const std::byte* from);

  Context& context_;
  Workers workers_;
};

}  // namespace trismooth::cuda
