// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace tbb {

/// Arenas of task_arena.h have as many threads as they are asked for.
class global_control {
 public:
  enum parameter { max_allowed_parallelism };

  global_control(parameter /*what*/, std::size_t /*value*/) {}
  static std::size_t active_value(parameter /*what*/) { return 1U << 20U; }
};

}  // namespace tbb
