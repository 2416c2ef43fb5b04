#include "trismooth/mesh_io/bytes/standard_output.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

#include "trismooth/mesh_io/bytes/broken_pipe.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

void write_standard_output(std::string_view bytes) {
  const BrokenPipeIsError this_thread;
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      throw WriteError("standard output", std::string("cannot be written: ") + std::strerror(errno));
    }
  }
}

}  // namespace trismooth
