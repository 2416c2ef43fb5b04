// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace trismooth {

/// Whether the whole name is as the pattern says: `*` stands for any characters or none, `?` for one byte, `\` before
/// either (or itself) for the character as it is. Upper and lower case count. Complexity: the product of the lengths.
bool matches_pattern(std::string_view pattern, std::string_view name);

/// Whether the pattern has a `*` or `?` that stands for others: if not, it names one array.
bool is_wild(std::string_view pattern);

}  // namespace trismooth
