/// Counts the instructions that work takes at a size and at four times that size. Runs under callgrind, whose counts
/// are the same in every run; growth.py starts it, and judges the counts. There is no clock.
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "cases.h"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define RUNNING_ON_VALGRIND 0
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name) static_cast<void>(name)
#endif

namespace {

constexpr int growth_factor = 4;
constexpr int least_size = 4;  // what is done for any input at all

void count(const GrowthCase& work, int size, const std::string& label) {
  const ScratchFolder folder;
  const std::function<void()> run = work.prepare(size, folder);
  const std::string name = label + " " + work.name;
  CALLGRIND_ZERO_STATS;
  run();
  CALLGRIND_DUMP_STATS_AT(name.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  if (RUNNING_ON_VALGRIND == 0) {
    std::puts("not counted: this program was not started under valgrind, or built without its headers");
    return 77;
  }
  CALLGRIND_START_INSTRUMENTATION;
  std::vector<GrowthCase> cases = file_cases();
  for (auto* const more : {&fem_file_cases, &flat_array_cases}) {
    for (GrowthCase& work : more()) {
      cases.push_back(std::move(work));
    }
  }
  for (const GrowthCase& work : cases) {
    if (work.name.find(only) != std::string::npos) {
      // The large one first: what is done once in a process matters least to it.
      count(work, growth_factor * work.size, "large");
      count(work, work.size, "small");
      count(work, least_size, "none");
    }
  }
  return 0;
}
