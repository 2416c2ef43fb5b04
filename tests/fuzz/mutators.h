// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "choices.h"

namespace fuzz {

/// Changes up to `capacity` bytes in place and answers how many there are then: LLVMFuzzerMutate.
using ByteMutator = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t capacity);

/// Puts another number into the place of one in a text: limits, special values, a neighbour, another of the text's.
/// Unchanged where there is none.
std::string mutate_number(const std::string& text, HashedChoices& choices);

/// Changes an encoded array of a VTU or VTP file: words of its block header, or its numbers, encoded and compressed
/// anew. Unchanged where there is none.
std::string mutate_xml_array(const std::string& file, HashedChoices& choices, ByteMutator mutate);

}  // namespace fuzz
