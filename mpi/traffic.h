// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth::mpi {

/// What a rank has sent to others.
struct Traffic {
  std::int64_t exchanges = 0;  ///< times that ghosts were brought up to date
  std::int64_t messages = 0;   ///< sent for that
  std::int64_t bytes = 0;      ///< in these
  std::int64_t joins = 0;      ///< times that all ranks joined numbers
};

}  // namespace trismooth::mpi
