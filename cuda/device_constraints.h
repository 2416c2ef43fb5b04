// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/smoothing/sliding.h"

namespace trismooth::cuda {

/// What the caller holds fixed, in device memory of the caller's; null where there is nothing. See
/// trismooth::Constraints.
struct DeviceConstraints {
  const std::uint8_t* fixed = nullptr;        ///< one flag a vertex: not 0 holds it
  const std::uint8_t* other_cells = nullptr;  ///< one flag a vertex: not 0 where a cell that is no element uses it
  const std::int32_t* fixed_ids = nullptr;    ///< vertex numbers
  std::int32_t fixed_id_count = 0;
  const std::int32_t* regions = nullptr;  ///< one number an element
  Sliding slide{};                        ///< which vertices slide; lines and links, which name vertices, must be none
};

}  // namespace trismooth::cuda
