#pragma once

#include <cstddef>

// Sanitizers bring their own malloc().
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define TRISMOOTH_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TRISMOOTH_SANITIZED
#endif

/// The most memory that this program has held at one time since a MemoryPeak was made, beyond what it held then;
/// malloc() and new of every library are counted. One at a time.
class MemoryPeak {
 public:
  MemoryPeak();
  std::size_t bytes() const;

 private:
  std::size_t held_before_;
};
