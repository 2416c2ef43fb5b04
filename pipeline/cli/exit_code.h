// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

/// What the program answers to the shell.
enum class ExitCode : int {
  done = 0,
  gate_failed = 1,   ///< the result misses a --require, or bits differ in `bench`; the output is written
  wrong_usage = 2,   ///< an unknown option, a bad value, options that do not fit the input
  bad_input = 3,     ///< the input cannot be read, is no planar triangle mesh or does not fit into memory
  not_written = 4,   ///< the output, a report or the standard output cannot be made or written
  device_error = 5,  ///< a CUDA error, or no device where --backend cuda was asked for
  cancelled = 130,   ///< Ctrl-C: nothing was written, or the message says so. What shells report after SIGINT
};

}  // namespace trismooth
