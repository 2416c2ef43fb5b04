// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace trismooth {

/// Writes that to standard output, past all buffers. Throws WriteError; a pipe that nobody reads is one, not a SIGPIPE.
void write_standard_output(std::string_view bytes);

}  // namespace trismooth
