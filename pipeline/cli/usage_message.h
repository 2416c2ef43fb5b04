// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace trismooth {

/// What was wrong with the command line, from what the parser made of it: its message, or a better one where that would
/// not help. A word that is no option or command is named with what may have been meant, several in the order in which
/// they were typed.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace trismooth
