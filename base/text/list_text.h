#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace trismooth {

/// "a, b, c": what text(item) says of each item, `between` them that; empty where there is none.
template <class Items, class Text = std::identity>
std::string list_text(const Items& items, const Text& text = {}, std::string_view between = ", ") {
  std::string list;
  for (const auto& item : items) {
    list.append(list.empty() ? "" : between).append(std::invoke(text, item));
  }
  return list;
}

}  // namespace trismooth
