// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace trismooth {

/// Names for arrays, no two alike. In trees, not hash tables: no choice of names makes them slow.
class FreeNames {
 public:
  /// The name is somebody else's from now on; it may be already.
  void take(std::string_view name) { taken_.emplace(name); }

  /// Takes `wanted`, or the first of wanted_1, wanted_2, ... that is free, and returns it. Complexity: logarithmic in
  /// the names so far, over all calls together, whatever the names are.
  std::string claim(std::string_view wanted);

 private:
  std::set<std::string, std::less<>> taken_;
  /// For names that were wanted again: the number to go on with. Those before it are taken and stay so.
  std::map<std::string, std::size_t, std::less<>> next_numbers_;
};

}  // namespace trismooth
