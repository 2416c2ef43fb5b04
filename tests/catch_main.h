// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Runs the test cases of the program as its command line says. Returns the exit code.
int run_catch(int argc, char** argv);
