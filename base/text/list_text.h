// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace trismooth {

/// Adds an item to a list of items with `between` between them.
inline void add_to_list(std::string& list, std::string_view item, std::string_view between = ", ") {
  list.append(list.empty() ? "" : between).append(item);
}

/// "a, b, c": what text(item) says of each item, `between` them that; empty where there is none.
template <class Items, class Text = std::identity>
std::string list_text(const Items& items, const Text& text = {}, std::string_view between = ", ") {
  std::string list;
  for (const auto& item : items) {
    add_to_list(list, std::invoke(text, item), between);
  }
  return list;
}

/// "a, b, ...": the first `most` items, and whether there are more.
template <class Items, class Text = std::identity>
std::string first_of_list(const Items& items, std::size_t most, const Text& text = {}) {
  std::string list;
  std::size_t count = 0;
  for (const auto& item : items) {
    if (count++ == most) {
      return list + ", ...";
    }
    add_to_list(list, std::invoke(text, item));
  }
  return list;
}

}  // namespace trismooth
