// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

#include "trismooth/pipeline/cli/exit_code.h"

namespace trismooth {

/// Prints the exception that is being handled (call it in a catch block only) to `err` as one message, with `whose` in
/// front, and answers the exit code that it stands for: the one place where exceptions become exit codes.
ExitCode report_failure(std::ostream& err, const std::string& whose = {});

}  // namespace trismooth
