// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into the ranks of a job that lasts: has operator new fail on one of them, as it does where memory is used
// up. In the environment of a run: FAILING_RANK; FAIL_AT, the number, from 1, of the allocation that fails, of those
// that count, which have 256 bytes at least and are made by the program itself or the standard library (other libraries
// need not stand it), 0 where none is to fail; FAILING_COUNT, how many fail from there on. COUNT_FILE: gets the number
// of those that count.

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include <dlfcn.h>

namespace {

constexpr std::size_t failing_bytes = 256;

long number_of(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? -1 : std::strtol(text, nullptr, 10);
}

bool is_failing_rank() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  const char* const failing = std::getenv("FAILING_RANK");
  return rank != nullptr && failing != nullptr && std::strcmp(rank, failing) == 0;
}

std::atomic<long> counted{0};

/// What fails in a run.
struct Plan {
  bool is_on = is_failing_rank();
  long first = number_of("FAIL_AT");
  long count = number_of("FAILING_COUNT");
};

Plan plan;

/// Behind a run: how many allocations there were.
void write_count() {
  const char* const path = std::getenv("COUNT_FILE");
  if (!plan.is_on || path == nullptr || counted == 0) {
    return;
  }
  if (std::FILE* const file = std::fopen(path, "w")) {
    std::fprintf(file, "%ld\n", counted.load());
    std::fclose(file);
  }
}

/// Whether that is code of the program, or of the standard library.
bool counts(const void* caller) {
  Dl_info found{};
  if (dladdr(caller, &found) == 0 || found.dli_fname == nullptr) {
    return false;
  }
  const std::string_view name(found.dli_fname);
  return name.find(".so") == std::string_view::npos || name.find("libstdc++") != std::string_view::npos;
}

bool fails(std::size_t size, const void* caller) {
  // Before the program has said what is to be done without memory, it has not begun.
  if (!plan.is_on || size < failing_bytes || std::get_new_handler() == nullptr || !counts(caller)) {
    return false;
  }
  const long number = ++counted;
  return plan.first > 0 && number >= plan.first && number < plan.first + plan.count;
}

void* allocated(std::size_t size, std::size_t alignment, const void* caller) {
  if (!fails(size, caller)) {
    const std::size_t wanted = size == 0 ? 1 : size;
    void* const memory = alignment == 0
                             ? std::malloc(wanted)
                             : std::aligned_alloc(alignment, (wanted + alignment - 1) / alignment * alignment);
    if (memory != nullptr) {
      return memory;
    }
  }
  if (const std::new_handler handler = std::get_new_handler()) {
    handler();  // the program's throws
  }
  throw std::bad_alloc();
}

}  // namespace

/// lasting_rank.cpp calls it in front of a run, whose environment it has by then, and behind it.
extern "C" void trismooth_plan_failures() {
  write_count();
  plan = {};
  counted = 0;
}

void* operator new(std::size_t size) {
  return allocated(size, 0, __builtin_return_address(0));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
