// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <new>
#include <utility>

#include <unistd.h>

#include "trismooth/mesh_io/bytes/input_file.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

/// The bytes that the file had when its size was asked for, or fewer.
void read_known_size(const InputFile& file, const FileWorkers& workers, MemoryBlock& block) {
  const std::size_t size = file.size();
  block.reserve_more(size + 1);  // the byte more is for the end of the file
  std::byte* const bytes = block.extend(size);
  const std::size_t part_bytes =
      workers.workers.count() == 1 ? std::max(size, std::size_t{1}) : std::size_t{1} << 21;  // a large page of memory
  std::atomic<std::size_t> end{size};
  const std::size_t parts = size / part_bytes + (size % part_bytes == 0 ? 0 : 1);
  workers.workers.for_blocks(static_cast<std::int64_t>(parts), 1, [&](std::int64_t first, std::int64_t last) {
    for (auto part = static_cast<std::size_t>(first); part < static_cast<std::size_t>(last); ++part) {
      const std::size_t begin = part * part_bytes;
      const std::size_t count = std::min(part_bytes, size - begin);
      const std::size_t got = file.read_at(bytes + begin, count, begin);
      if (got < count) {
        std::size_t before = end;
        while (begin + got < before && !end.compare_exchange_weak(before, begin + got)) {
        }
      }
    }
  });
  block.truncate(end);
  file.seek(end);
}

/// Appends what the file has from where it stands to its end.
void read_rest(const InputFile& file, MemoryBlock& block) {
  std::size_t step = 1;
  for (;;) {
    const std::size_t before = block.size();
    const std::size_t got = file.read_on(block.extend(step), step);
    block.truncate(before + got);
    if (got < step) {
      return;
    }
    constexpr std::size_t least_step = std::size_t{1} << 16;
    step = std::max(least_step, block.size());
  }
}

}  // namespace

FileBytes read_file_bytes(const std::filesystem::path& path, const FileWorkers& workers) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw ReadError(path, "is a folder, not a file");
  }
  const InputFile file(path);
  try {
    MemoryBlock block;
    read_known_size(file, workers, block);
    read_rest(file, block);  // of a file that has grown meanwhile, or one without a size
    return FileBytes(std::move(block));
  } catch (const std::bad_alloc&) {
    throw ReadError(path, "is too large for the memory of this machine");
  }
}

FileBytes read_standard_input() {
  const std::filesystem::path name = "standard input";
  const InputFile file(name, STDIN_FILENO);
  try {
    MemoryBlock block;
    read_rest(file, block);
    return FileBytes(std::move(block));
  } catch (const std::bad_alloc&) {
    throw ReadError(name, "is too large for the memory of this machine");
  }
}

FileBytes read_file_bytes(const std::filesystem::path& path) {
  Workers alone(1);
  return read_file_bytes(path, FileWorkers(alone));
}

}  // namespace trismooth
