// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into the ranks of a job: has operator new fail on one of them, as it does where memory is used up. In the
// environment: FAILING_RANK; FAIL_AT, the number, from 1, of the allocation that fails, of those that count, which have
// 256 bytes at least and are made by the program itself
// or the standard library (other libraries need not stand it); FAILING_COUNT, how many fail from there on. COUNT_FILE:
// gets the number of those that count.

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

/// Of a process: what fails in it, and at its end how many allocations there were.
struct Plan {
  bool is_on = is_failing_rank();
  long first = number_of("FAIL_AT");
  long count = number_of("FAILING_COUNT");
  const char* count_file = std::getenv("COUNT_FILE");

  Plan() = default;
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  ~Plan() {
    if (!is_on || count_file == nullptr) {
      return;
    }
    if (std::FILE* const file = std::fopen(count_file, "w")) {
      std::fprintf(file, "%ld\n", counted.load());
      std::fclose(file);
    }
  }
};

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
  static const Plan plan;
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

void* operator new(std::size_t size) {
  return allocated(size, 0, __builtin_return_address(0));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
