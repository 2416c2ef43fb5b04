// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "trismooth/base/machine/call_limit.h"

namespace trismooth {

/// A number of threads to run loops on. No result of this project depends on the number: loops write to places of
/// their own, and sums go over fixed blocks in a fixed order. In a process that fork() has made of one whose threads
/// were at work, loops run on the calling thread: fork() takes that thread along and no other. The threads are TBB's,
/// whose headers workers.cpp and worker_threads.cpp alone include; one more source,
/// mesh_io/vtk_xml/vtk_xml_writer.cpp, does so to hold VTK to one thread.
class Workers {
 public:
  /// `threads` = 0: one for each core that the process may use. More threads than cores are really started,
  /// unless the system refuses them; then the loops have to do with fewer. Throws std::invalid_argument for a negative
  /// number and for more than most_threads().
  explicit Workers(int threads);
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();

  /// The threads that loops run on.
  int count() const { return count_; }

  /// Calls `function` on this thread, as one of the workers: every for_blocks() that it calls is cheaper than outside.
  template <class Function>
  void run(Function&& function) {
    if (count_ == 1) {
      function();
      return;
    }
    const auto call = [&function] { function(); };
    enter(callee_of<>(call));
  }

  /// Calls body(begin, end) on parts of [0, size) of no less than half of `grain` elements, in any order, on all
  /// threads; on the calling thread alone, in one part, where there is one thread or no more than `grain` elements, and
  /// in some parts where that thread has a CallLimit. Where that is over CallEnded leaves the loop between two parts,
  /// and nobody is at work on one any more.
  template <class Body>
  void for_blocks(std::int64_t size, std::int64_t grain, const Body& body) {
    if (size <= 0) {
      return;
    }
    if (CallLimit* const limit = CallLimit::current(); limit != nullptr && !limit->is_lifted()) {
      share_out_within(*limit, size, grain, callee_of<std::int64_t, std::int64_t>(body));
      return;
    }
    if (count_ == 1 || size <= grain) {
      body(std::int64_t{0}, size);
      return;
    }
    share_out(size, grain, callee_of<std::int64_t, std::int64_t>(body));
  }

  /// Calls work(block, place) for the blocks 0 to `count` - 1, on all threads, and then(block, place) for each of them
  /// behind it, one at a time and in their order, on any thread. `place` is less than `places`, which is at least 1,
  /// and no two blocks have the same between the begin of `work` and the end of `then`: so many blocks are on their way
  /// at most. The first block at which either throws is the last one that `then` is called for, if at all, and that
  /// exception reaches the caller. `work` and `then` may not call loops of these workers. On the calling thread alone,
  /// block by block at place 0, where there is one thread or one block.
  template <class Work, class Then>
  void for_blocks_in_order(std::size_t count, std::size_t places, const Work& work, const Then& then) {
    if (count_ == 1 || count <= 1) {
      for (std::size_t block = 0; block < count; ++block) {
        work(block, std::size_t{0});
        then(block, std::size_t{0});
      }
      return;
    }
    line_up(count, places, callee_of<std::size_t, std::size_t>(work), callee_of<std::size_t, std::size_t>(then));
  }

 private:
  /// A function object of any type, called through a pointer: what calls it is compiled once.
  template <class... Arguments>
  struct Callee {
    const void* object;
    void (*call)(const void* object, Arguments...);

    void operator()(Arguments... arguments) const { call(object, arguments...); }
  };
  template <class... Arguments, class Function>
  static Callee<Arguments...> callee_of(const Function& function) {
    return {&function,
            [](const void* object, Arguments... arguments) { (*static_cast<const Function*>(object))(arguments...); }};
  }
  struct Arena;

  void start();
  void enter(const Callee<>& function);
  void share_out(std::int64_t size, std::int64_t grain, const Callee<std::int64_t, std::int64_t>& body);
  void share_out_within(CallLimit& limit, std::int64_t size, std::int64_t grain,
                        const Callee<std::int64_t, std::int64_t>& body);
  void line_up(std::size_t count, std::size_t places, const Callee<std::size_t, std::size_t>& work,
               const Callee<std::size_t, std::size_t>& then);

  int count_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace trismooth
