// SPDX-License-Identifier: BSD-3-Clause
// The runner of Catch2, compiled once for all test programs, and their main.

#define CATCH_CONFIG_RUNNER
#include "catch_main.h"

#include "catch.h"

int run_catch(int argc, char** argv) {
  return Catch::Session().run(argc, argv);
}

// Weak: programs with something to do before have a main of their own.
[[gnu::weak]] int main(int argc, char** argv) {
  return run_catch(argc, argv);
}
