#pragma once

#include <algorithm>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace trismooth {

/// A TBB arena of at most `threads` threads, of all that TBB may use where `threads` is not positive. Never more than
/// those: TBB would not start them and would complain on standard error.
inline tbb::task_arena thread_arena(int threads) {
  const auto limit = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return {threads > 0 ? std::min(threads, limit) : limit};
}

}  // namespace trismooth
