// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/paper/bench_command.h"
#include "trismooth/pipeline/cli/command_line.h"

int main(int argc, char** argv) {
  return trismooth::run_program(argc, argv, {&trismooth::add_bench_command});
}
