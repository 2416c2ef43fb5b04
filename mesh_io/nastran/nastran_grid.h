// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace trismooth {

/// Appends the GRID whose text is text[begin, ...) with the coordinates `now` in place of those of `before` that are
/// others, bit for bit; where the card's text ends. New numbers have 16 characters at most. They stand where the old
/// ones stood, with the blanks of their columns. If one is longer than a small field, or its field is not there, the
/// card's first lines are written anew in large field, its other fields as they are. Free field stays free.
std::size_t append_moved_grid(std::string_view text, std::size_t begin, const std::array<double, 3>& before,
                              const std::array<double, 3>& now, std::string& out);

}  // namespace trismooth
