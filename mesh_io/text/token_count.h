// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trismooth {

/// Tokens, separated by white space (see is_white_space), that begin in text[begin, end).
std::uint64_t count_tokens(std::string_view text, std::size_t begin, std::size_t end);

}  // namespace trismooth
