// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/workers.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <new>
#include <stdexcept>
#include <string_view>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "trismooth/base/machine/block_line.h"
#include "trismooth/base/machine/worker_threads.h"

namespace trismooth {

namespace {

int threads_for(int wanted) {
  if (checked_threads(wanted) == 1 || has_lost_threads()) {
    return 1;
  }
  return allowed_threads(wanted > 0 ? wanted : tbb::this_task_arena::max_concurrency());
}

/// Runs work of TBB. It may want one thread more than start_worker_threads() has started, long after that: where one is
/// about to fall asleep. If the mesh has taken what the system allowed by then, that is a lack of memory, and fewer
/// threads help; TBB calls it a runtime error.
template <class Work>
void execute(tbb::task_arena& arena, const Work& work) {
  try {
    arena.execute(work);
  } catch (const std::runtime_error& error) {
    if (std::string_view(error.what()).starts_with("pthread_create")) {
      throw std::bad_alloc();
    }
    throw;
  }
}

}  // namespace

struct Workers::Arena {
  explicit Arena(int threads) : arena(threads) {
    if (threads > tbb::this_task_arena::max_concurrency()) {
      limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
    }
  }

  std::unique_ptr<tbb::global_control> limit;  ///< where there are to be more threads than cores
  tbb::task_arena arena;
};

Workers::Workers(int threads)
    : count_(threads_for(threads)), arena_(count_ > 1 ? std::make_unique<Arena>(count_) : nullptr) {}

Workers::~Workers() {
  if (has_lost_threads()) {
    // Not destroyed: fork() may have come while one of them had a lock of TBB's, and here nobody opens it.
    static_cast<void>(arena_.release());  // NOLINT(bugprone-unused-return-value)
  }
}

void Workers::start() {
  const int allowed = start_worker_threads(count_);
  if (allowed < count_) {
    count_ = allowed;
    arena_->arena.initialize(allowed);  // unless it is at work already
  }
}

void Workers::enter(const Callee<>& function) {
  if (has_lost_threads()) {
    function();
    return;
  }
  expect_fork();
  execute(arena_->arena, [&] { function(); });
}

void Workers::share_out(std::int64_t size, std::int64_t grain, const Callee<std::int64_t, std::int64_t>& body) {
  if (has_lost_threads()) {
    body(std::int64_t{0}, size);
    return;
  }
  start();
  execute(arena_->arena, [&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, size, static_cast<std::size_t>(grain)),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  });
}

void Workers::share_out_within(CallLimit& limit, std::int64_t size, std::int64_t grain,
                               const Callee<std::int64_t, std::int64_t>& body) {
  const auto checked = [&limit, &body](std::int64_t begin, std::int64_t end) {
    limit.check();
    body(begin, end);
  };
  if (count_ > 1 && size > grain) {
    limit.check();  // TBB does not promise that this thread, which alone asks the caller, gets a part
    share_out(size, grain, callee_of<std::int64_t, std::int64_t>(checked));
    return;
  }
  constexpr std::int64_t most_parts = 16;
  const std::int64_t parts = std::clamp<std::int64_t>(size / grain, 1, most_parts);
  for (std::int64_t part = 0; part < parts; ++part) {
    checked(size / parts * part, part + 1 == parts ? size : size / parts * (part + 1));
  }
}

void Workers::line_up(std::size_t count, std::size_t places, const Callee<std::size_t, std::size_t>& work,
                      const Callee<std::size_t, std::size_t>& then) {
  const BlockLine::Step work_step = std::ref(work);
  const BlockLine::Step then_step = std::ref(then);
  BlockLine line(count, places, work_step, then_step);
  for_blocks(count_, 1, [&line](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      line.serve();
    }
  });
  line.rethrow();
}

}  // namespace trismooth
