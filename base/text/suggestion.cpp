// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/suggestion.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

/// F. J. Damerau: A technique for computer detection and correction of spelling errors. Communications of the ACM 7(3),
/// 171-176, 1964; each letter takes part in one swap at most.
std::size_t distance(std::string_view one, std::string_view other) {
  std::vector<std::vector<std::size_t>> cost(one.size() + 1, std::vector<std::size_t>(other.size() + 1));
  for (std::size_t i = 0; i <= one.size(); ++i) {
    for (std::size_t j = 0; j <= other.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t substitution = one[i - 1] == other[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + substitution});
      if (i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[one.size()][other.size()];
}

/// In a word of so many letters; among the shortest too many are one letter apart.
std::size_t most_errors(std::size_t letters) {
  return letters < 4 ? 0 : letters < 6 ? 1 : letters / 3;
}

/// The one candidate that begins with `start`, or null.
const std::string* only_one_beginning_with(std::string_view start, std::span<const std::string> candidates) {
  constexpr std::size_t least_letters = 3;
  const auto begins = [&](const std::string& candidate) { return lower_case(candidate).starts_with(start); };
  const bool is_one = start.size() >= least_letters && std::ranges::count_if(candidates, begins) == 1;
  return is_one ? &*std::ranges::find_if(candidates, begins) : nullptr;
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t longest = 64;
  if (word.empty() || word.size() > longest) {
    return {};
  }
  const std::string typed = lower_case(word);
  const std::string* best = nullptr;
  std::size_t least = typed.size();
  for (const std::string& candidate : candidates) {
    const std::size_t errors = distance(typed, lower_case(candidate));
    if (errors < least && errors <= most_errors(std::max(typed.size(), candidate.size()))) {
      least = errors;
      best = &candidate;
    }
  }
  if (best == nullptr) {
    best = only_one_beginning_with(typed, candidates);
  }
  return best == nullptr ? std::string() : " (did you mean '" + *best + "'?)";
}

}  // namespace trismooth
