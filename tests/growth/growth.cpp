// SPDX-License-Identifier: BSD-3-Clause
/// Counts the instructions that work takes at a size and at four times that size. Runs under callgrind, whose counts
/// are the same in every run; growth.py starts it, and judges the counts. There is no clock.
#include <cstdio>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cases.h"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define RUNNING_ON_VALGRIND 0
#define CALLGRIND_START_INSTRUMENTATION
#define VALGRIND_PRINTF(...) static_cast<void>(0)
#define VALGRIND_MONITOR_COMMAND(command) static_cast<void>(command)
#endif

namespace {

constexpr int growth_factor = 4;
constexpr int least_size = 4;  // what is done for any input at all

/// Work on an input that lies ready.
struct Prepared {
  std::string name;
  ScratchFolder folder;
  std::function<void()> run;
};

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  if (RUNNING_ON_VALGRIND == 0) {
    std::puts("not counted: this program was not started under valgrind, or built without its headers");
    return 77;
  }
  std::vector<GrowthCase> cases = file_cases();
  for (auto* const more : {&fem_file_cases, &flat_array_cases}) {
    for (GrowthCase& work : more()) {
      cases.push_back(std::move(work));
    }
  }
  // All is prepared before anything is counted, for valgrind is fast until then.
  std::deque<Prepared> all;
  for (const GrowthCase& work : cases) {
    if (work.name.find(only) != std::string::npos) {
      // The large one first: what is done once in a process matters least to it.
      for (const auto& [label, size] : {std::pair{"large ", growth_factor * work.size}, std::pair{"small ", work.size},
                                        std::pair{"none ", least_size}}) {
        Prepared& prepared = all.emplace_back();
        prepared.name = label + work.name;
        prepared.run = work.prepare(size, prepared.folder);
      }
    }
  }
  CALLGRIND_START_INSTRUMENTATION;
  // What has been counted so far goes to valgrind's log. (A dump would hold it as well, and takes longer than most
  // work.)
  VALGRIND_MONITOR_COMMAND("status internal");
  for (const Prepared& work : all) {
    work.run();
    VALGRIND_MONITOR_COMMAND("status internal");
    VALGRIND_PRINTF("up to here: %s\n", work.name.c_str());
  }
  return 0;
}
