// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/standard_output.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

#include "trismooth/mesh_io/bytes/broken_pipe.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

void write_standard_output(std::string_view bytes) {
  if (!write_to_descriptor(STDOUT_FILENO, bytes)) {
    throw WriteError("standard output", std::string("cannot be written: ") + std::strerror(errno));
  }
}

}  // namespace trismooth
