#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/cuda/context.h"
#include "trismooth/cuda/device_buffer.h"
#include "trismooth/quality/workers.h"
#include "trismooth/smoothing/overwriting.h"

namespace trismooth::cuda {

/// What a download that breaks off leaves behind.
enum class OnFailure : std::uint8_t {
  leave_partly_written,
  restore,  ///< what was there before; takes as much memory again, for as long as the copier lives
};

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
  void download(std::span<T> to, const DeviceBuffer<T>& from, OnFailure on_failure = OnFailure::leave_partly_written) {
    download(to.data(), from.data(), to.size_bytes(), on_failure);
  }

 private:
  void upload(void* to, const void* from, std::size_t bytes);
  void download(void* to, const void* from, std::size_t bytes, OnFailure on_failure);
  /// Piece by piece through page-locked memory. False where there is none to be had.
  bool download_through_slots(const std::byte* from, std::size_t bytes, Overwriting& target);

  Context& context_;
  Workers workers_;
  ScratchBytes kept_;
};

}  // namespace trismooth::cuda
