// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "mutators.h"
#include "targets.h"

/// The entries of libFuzzer: fuzz --target=NAME, and what else libFuzzer takes, which leaves alone what begins with
/// "--".

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t capacity);

namespace {

const fuzz::Target* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--target=";
  for (const std::string_view argument : std::span(*arguments, static_cast<std::size_t>(*count))) {
    if (argument.starts_with(option)) {
      target = &fuzz::find_target(argument.substr(option.size()));
      return 0;
    }
  }
  std::fputs("usage: fuzz --target=NAME [OPTION OF LIBFUZZER]... [INPUT]...\n", stderr);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size <= fuzz::most_input_bytes) {
    target->run({data, size});
  }
  return 0;
}

/// libFuzzer's own mutations, and where the target has numbers, mutations of these.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t capacity,
                                               unsigned seed) {
  fuzz::HashedChoices choices(seed);
  const std::size_t kind = choices.below(8);
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::string changed = target->is_xml() && kind < 3 ? fuzz::mutate_xml_array(input, choices, &LLVMFuzzerMutate)
                              : target->format && kind < 5 ? fuzz::mutate_number(input, choices)
                                                           : input;
  if (changed == input || changed.size() > capacity) {
    return LLVMFuzzerMutate(data, size, capacity);
  }
  std::ranges::copy(changed, data);
  return changed.size();
}
