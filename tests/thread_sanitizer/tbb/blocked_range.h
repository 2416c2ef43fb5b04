// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tbb {

template <class T>
class blocked_range {
 public:
  blocked_range(T begin, T end, T grain) : begin_(begin), end_(end), grain_(grain) {}

  T begin() const { return begin_; }
  T end() const { return end_; }
  T grainsize() const { return grain_; }

 private:
  T begin_;
  T end_;
  T grain_;
};

}  // namespace tbb
