// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trismooth {

/// The word as a shell (bash, zsh, ksh, or any of POSIX 2024) reads it back: as it is where it has harmless characters
/// alone, else in quotes. Control characters, and bytes that are no UTF-8, are octal codes within $'...': the result is
/// valid UTF-8 in one line, and safe to show on a terminal.
std::string shell_word(std::string_view word);

/// The words, quoted as they need it, with blanks between them: a command line to paste.
std::string shell_command(std::span<const std::string> words);

}  // namespace trismooth
