#include "trismooth/mesh_io/bytes/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw ReadError(path_, std::string("cannot be opened: ") + std::strerror(errno));
    }
  }
  /// Of the file that is open under that number.
  InputFile(const std::filesystem::path& path, int descriptor)
      : path_(path), descriptor_(::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)) {
    if (descriptor_ < 0) {
      throw ReadError(path_, std::string("cannot be read: ") + std::strerror(errno));
    }
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { ::close(descriptor_); }

  /// Of a regular file; 0 of all else, whose size says nothing.
  std::size_t size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
  }

  /// Reads up to `count` bytes from `offset` on; fewer where the file ends.
  std::size_t read_at(std::byte* bytes, std::size_t count, std::size_t offset) const {
    return read_all(count, [&](std::size_t done) {
      return ::pread(descriptor_, bytes + done, count - done, static_cast<off_t>(offset + done));
    });
  }

  /// The same from where the last call of it ended: for pipes too.
  std::size_t read_on(std::byte* bytes, std::size_t count) const {
    return read_all(count, [&](std::size_t done) { return ::read(descriptor_, bytes + done, count - done); });
  }

  void seek(std::size_t offset) const { ::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET); }

 private:
  template <class Read>
  std::size_t read_all(std::size_t count, const Read& read) const {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t got = read(done);
      if (got == 0) {
        break;
      }
      if (got > 0) {
        done += static_cast<std::size_t>(got);
      } else if (errno != EINTR) {
        throw ReadError(path_, std::string("cannot be read: ") + std::strerror(errno));
      }
    }
    return done;
  }

  const std::filesystem::path& path_;
  int descriptor_;
};

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
    throw ReadError(path, "is a folder, not a mesh file");
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
