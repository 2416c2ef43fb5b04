// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trismooth {

/// " (did you mean 'smooth'?)" where one of the candidates is near enough to `word` to have been meant: equal but for
/// upper and lower case, the only one that begins so (three letters at least), or the nearest by insertions, deletions,
/// substitutions and swaps of neighbours (Damerau, optimal string alignment): none in three letters, one in five, one
/// for every three in more. Empty where none is. Complexity: the product of the lengths, for each candidate; words
/// longer than 64 have none.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace trismooth
