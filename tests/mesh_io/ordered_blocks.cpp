// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/ordered_blocks.h"

#include <atomic>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::BufferedWriter;
using trismooth::FileWorkers;
using trismooth::MemoryBlock;
using trismooth::OrderedBlocks;
using trismooth::Workers;

TEST_CASE("rows are encoded once each, in blocks of as many as a part holds, and leave in their order") {
  Workers workers(GENERATE(1, 3));
  for (const std::size_t part_bytes : {std::size_t{0}, std::size_t{1}, std::size_t{40}, FileWorkers::whole}) {
    for (const std::size_t count : {0, 1, 3, 4, 5, 1000}) {
      CAPTURE(part_bytes, count);
      std::vector<std::uint32_t> rows;
      std::vector<std::size_t> sizes;
      std::atomic<bool> empty{true};
      const auto sink = [&](std::string_view bytes) {
        sizes.push_back(bytes.size() / sizeof(std::uint32_t));
        rows.resize(rows.size() + sizes.back());
        std::memcpy(rows.data() + rows.size() - sizes.back(), bytes.data(), bytes.size());
      };
      OrderedBlocks(sink, FileWorkers(workers, part_bytes))
          .write_rows(count, 10, [&empty](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
            empty = empty && bytes.size() == 0;
            for (auto row = static_cast<std::uint32_t>(begin); row < end; ++row) {
              std::memcpy(bytes.extend(sizeof(row)), &row, sizeof(row));
            }
          });
      std::vector<std::uint32_t> expected(count);
      std::iota(expected.begin(), expected.end(), 0U);
      CHECK(rows == expected);
      CHECK(empty);
      const std::size_t each = part_bytes == FileWorkers::whole ? FileWorkers::default_part_bytes / 10
                               : part_bytes == 40               ? 4
                                                                : 1;
      CHECK(sizes.size() == (count + each - 1) / each);
    }
  }
}

TEST_CASE("a pipe that nobody reads any more is an error of the write, whichever thread writes") {
  const ScratchFolder folder;
  const auto pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  for (int round = 0; round < 10; ++round) {
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    BufferedWriter writer(pipe);
    ::close(reader);
    Workers workers(8);
    OrderedBlocks blocks([&writer](std::string_view bytes) { writer.write(bytes); }, FileWorkers(workers));
    const auto encode = [](std::size_t /*block*/, MemoryBlock& bytes) {
      constexpr std::size_t size = std::size_t{1} << 17;
      std::memset(bytes.extend(size), 'x', size);
    };
    CHECK(message_of<trismooth::WriteError>([&] { blocks.write(50, encode); }) ==
          pipe.string() + ": cannot be written: Broken pipe");
  }
}
