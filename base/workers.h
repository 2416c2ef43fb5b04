#pragma once

#include <cstdint>
#include <memory>

namespace trismooth {

/// A number of threads to run loops on. No result of this project depends on the number: loops write to places of
/// their own, and sums go over fixed blocks in a fixed order. The threads are TBB's, whose headers workers.cpp alone
/// includes.
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
    enter({&call, [](const void* object) { (*static_cast<decltype(&call)>(object))(); }});
  }

  /// Starts the threads. For those who call TBB by themselves in run(); for_blocks() does it where it has to.
  void start();

  /// Calls body(begin, end) on parts of [0, size) of no less than half of `grain` elements, in any order, on all
  /// threads; on the calling thread alone, in one part, where there is one thread or no more than `grain` elements.
  template <class Body>
  void for_blocks(std::int64_t size, std::int64_t grain, const Body& body) {
    if (size <= 0) {
      return;
    }
    if (count_ == 1 || size <= grain) {
      body(std::int64_t{0}, size);
      return;
    }
    share_out(size, grain, {&body, [](const void* object, std::int64_t begin, std::int64_t end) {
                              (*static_cast<const Body*>(object))(begin, end);
                            }});
  }

 private:
  /// A function object of any type, called through a pointer: what calls it is compiled once.
  template <class... Arguments>
  struct Callee {
    const void* object;
    void (*call)(const void* object, Arguments...);

    void operator()(Arguments... arguments) const { call(object, arguments...); }
  };
  struct Arena;

  void enter(const Callee<>& function);
  void share_out(std::int64_t size, std::int64_t grain, const Callee<std::int64_t, std::int64_t>& body);

  int count_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace trismooth
