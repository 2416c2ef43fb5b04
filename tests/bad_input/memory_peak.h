// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/// The most memory that this program has held at one time since a MemoryPeak was made, beyond what it held then;
/// malloc() and new of every library are counted. One at a time.
class MemoryPeak {
 public:
  MemoryPeak();
  std::size_t bytes() const;

 private:
  std::size_t held_before_;
};
