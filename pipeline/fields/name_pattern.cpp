// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/name_pattern.h"

#include <cstddef>

namespace trismooth {

namespace {

/// The length of what stands for one character at the begin of the pattern.
std::size_t length_of_first(std::string_view pattern) {
  return pattern.front() == '\\' && pattern.size() > 1 ? 2 : 1;
}

bool first_matches(std::string_view pattern, char character) {
  const std::size_t length = length_of_first(pattern);
  return length == 2 ? pattern[1] == character : pattern.front() == '?' || pattern.front() == character;
}

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view name) {
  // Where the last star was, and the first character that it does not stand for: it takes one more where the rest
  // fails.
  bool has_star = false;
  std::string_view behind_star;
  std::string_view retry;
  while (!name.empty()) {
    if (!pattern.empty() && pattern.front() == '*') {
      pattern.remove_prefix(1);
      has_star = true;
      behind_star = pattern;
      retry = name;
    } else if (!pattern.empty() && first_matches(pattern, name.front())) {
      pattern.remove_prefix(length_of_first(pattern));
      name.remove_prefix(1);
    } else if (has_star) {
      retry.remove_prefix(1);
      name = retry;
      pattern = behind_star;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*') == std::string_view::npos;
}

bool is_wild(std::string_view pattern) {
  while (!pattern.empty()) {
    if (pattern.front() == '*' || pattern.front() == '?') {
      return true;
    }
    pattern.remove_prefix(length_of_first(pattern));
  }
  return false;
}

}  // namespace trismooth
