// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/overwriting.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"

using trismooth::Overwriting;
using trismooth::ScratchBytes;
using trismooth::Workers;

namespace {

std::vector<std::byte> bytes(std::size_t size, int first) {
  std::vector<std::byte> values(size);
  for (std::size_t i = 0; i < size; ++i) {
    values[i] = static_cast<std::byte>(first + static_cast<int>(i * i % 251));
  }
  return values;
}

/// Overwrites in pieces, every other one by somebody else's hand, and fails before piece `failing`.
void overwrite(std::vector<std::byte>& memory, const std::vector<std::byte>& with, std::size_t piece_size,
               std::size_t failing, ScratchBytes* kept, bool meanwhile, Workers& workers) {
  Overwriting overwriting(memory, kept, workers);
  if (meanwhile) {
    overwriting.keep_meanwhile();
  }
  for (std::size_t piece = 0, begin = 0; begin < memory.size(); ++piece, begin += piece_size) {
    if (piece == failing) {
      throw std::runtime_error("the device is gone");
    }
    const std::size_t size = std::min(piece_size, memory.size() - begin);
    if (piece % 2 == 0) {
      overwriting.write(with.data() + begin, size);
    } else {
      overwriting.give_away(size);
      std::copy_n(with.begin() + static_cast<std::ptrdiff_t>(begin), size / 2,
                  memory.begin() + static_cast<std::ptrdiff_t>(begin));
      if (piece + 1 == failing) {
        throw std::runtime_error("the device is gone in the middle of a piece");
      }
      std::copy_n(with.begin() + static_cast<std::ptrdiff_t>(begin), size,
                  memory.begin() + static_cast<std::ptrdiff_t>(begin));
    }
  }
  overwriting.done();
}

}  // namespace

TEST_CASE("memory that is overwritten in pieces has the new bytes or the old ones, wherever it breaks off") {
  for (const auto& [threads, meanwhile] : {std::pair{1, false}, {1, true}, {3, false}, {3, true}}) {
    Workers workers(threads);
    ScratchBytes kept;
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{700001}}) {
      const std::size_t piece_size = size / 5 + 1;
      const std::vector<std::byte> before = bytes(size, 3);
      const std::vector<std::byte> after = bytes(size, 100);
      for (std::size_t failing = 0; failing * piece_size < size; ++failing) {
        CAPTURE(threads, meanwhile, size, failing);
        std::vector<std::byte> memory = before;
        CHECK_THROWS_AS(overwrite(memory, after, piece_size, failing, &kept, meanwhile, workers), std::runtime_error);
        CHECK(memory == before);
      }
      std::vector<std::byte> memory = before;
      overwrite(memory, after, piece_size, size + 1, &kept, meanwhile, workers);
      CHECK(memory == after);
    }
  }
}

TEST_CASE("what is not kept stays overwritten") {
  Workers workers(1);
  std::vector<std::byte> memory = bytes(10, 3);
  const std::vector<std::byte> after = bytes(10, 100);
  CHECK_THROWS_AS(overwrite(memory, after, 5, 1, nullptr, true, workers), std::runtime_error);
  CHECK(std::equal(memory.begin(), memory.begin() + 5, after.begin()));
}
