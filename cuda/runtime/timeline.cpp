// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/runtime/timeline.h"

#include "trismooth/cuda/runtime/check.h"

namespace trismooth::cuda {

Timeline::~Timeline() {
  for (cudaEvent_t event : events_) {
    cudaEventDestroy(event);
  }
}

void Timeline::mark() {
  if (marked_ == events_.size()) {
    cudaEvent_t event = nullptr;
    TRISMOOTH_CUDA_CHECK(cudaEventCreate(&event));
    events_.push_back(event);
  }
  TRISMOOTH_CUDA_CHECK(cudaEventRecord(events_[marked_], context_.stream()));
  ++marked_;
}

double Timeline::milliseconds(std::size_t from) const {
  TRISMOOTH_CUDA_CHECK(cudaEventSynchronize(events_[from + 1]));
  float elapsed = 0;
  TRISMOOTH_CUDA_CHECK(cudaEventElapsedTime(&elapsed, events_[from], events_[from + 1]));
  return static_cast<double>(elapsed);
}

}  // namespace trismooth::cuda
