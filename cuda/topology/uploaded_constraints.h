// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/device_constraints.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/constraints.h"

namespace trismooth::cuda {

/// The caller's constraints in device memory of our own, for as long as it takes to read them.
class UploadedConstraints {
 public:
  UploadedConstraints() = default;
  UploadedConstraints(Context& context, const Constraints& constraints)
      : fixed_(context, constraints.fixed),
        other_cells_(context, constraints.other_cells),
        fixed_ids_(context, constraints.fixed_ids),
        regions_(context, constraints.regions),
        slide_(constraints.slide) {}

  /// Valid for as long as this object. The lengths are not checked here: see check_constraints().
  DeviceConstraints view() const {
    return {fixed_.data(),     other_cells_.data(),
            fixed_ids_.data(), static_cast<std::int32_t>(fixed_ids_.size()),
            regions_.data(),   slide_};
  }

 private:
  DeviceBuffer<std::uint8_t> fixed_;
  DeviceBuffer<std::uint8_t> other_cells_;
  DeviceBuffer<std::int32_t> fixed_ids_;
  DeviceBuffer<std::int32_t> regions_;
  Sliding slide_;
};

}  // namespace trismooth::cuda
