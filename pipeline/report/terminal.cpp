// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/terminal.h"

#include <sys/ioctl.h>

namespace trismooth {

std::size_t terminal_columns(int descriptor) {
  winsize size{};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : line_columns;
}

}  // namespace trismooth
