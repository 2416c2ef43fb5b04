// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/native_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "trismooth/mesh_io/bytes/shared_blocks.h"

namespace trismooth {

namespace {

template <class Word>
void swap_words(std::byte* bytes, std::size_t count, const FileWorkers& workers) {
  for_file_blocks(workers, count, sizeof(Word), [bytes](std::size_t begin, std::size_t end) {
    for (std::byte* word = bytes + begin * sizeof(Word); word != bytes + end * sizeof(Word); word += sizeof(Word)) {
      std::reverse(word, word + sizeof(Word));
    }
  });
}

}  // namespace

void to_native_order(std::byte* bytes, std::size_t size, std::size_t word_size, bool big_endian,
                     const FileWorkers& workers) {
  if (big_endian == (std::endian::native == std::endian::big)) {
    return;
  }
  switch (word_size) {
    case 2:
      return swap_words<std::uint16_t>(bytes, size / 2, workers);
    case 4:
      return swap_words<std::uint32_t>(bytes, size / 4, workers);
    case 8:
      return swap_words<std::uint64_t>(bytes, size / 8, workers);
    default:
      return;
  }
}

}  // namespace trismooth
