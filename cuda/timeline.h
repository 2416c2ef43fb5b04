#pragma once

#include <cstddef>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/context.h"

namespace trismooth::cuda {

/// Moments in the work of a stream, for the time between them.
class Timeline {
 public:
  explicit Timeline(const Context& context) : context_(context) {}
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;
  ~Timeline();

  /// Marks the moment when all that is queued so far will be done.
  void mark();
  /// Milliseconds from moment `from` to the next; waits for the latter.
  double milliseconds(std::size_t from) const;

 private:
  const Context& context_;
  std::vector<cudaEvent_t> events_;
};

}  // namespace trismooth::cuda
