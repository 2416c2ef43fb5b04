// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/gzip.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <zlib.h>

#include "trismooth/mesh_io/errors.h"

// RFC 1952 says how such files are built. Compressed is as pigz does it: blocks of a fixed size, each with the end of
// the one before it as its dictionary, so that all workers share one member.
namespace trismooth {

namespace {

constexpr int window_bits = 15;
constexpr int with_gzip_header = 16;
constexpr std::size_t most_bytes_a_call = std::size_t{1} << 30;  // zlib counts in 32 bits

class Inflater {
 public:
  explicit Inflater(std::string_view bytes) : left_(bytes) {
    if (::inflateInit2(&stream_, window_bits + with_gzip_header) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { ::inflateEnd(&stream_); }

  /// Goes on with up to `count` bytes at `target`; answers how many there were. `status` is zlib's.
  std::size_t inflate(std::byte* target, std::size_t count, int& status) {
    const std::size_t given = std::min(left_.size(), most_bytes_a_call);
    // zlib takes bytes that it only reads as bytes that it might write.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));  // NOLINT
    stream_.avail_in = static_cast<uInt>(given);
    stream_.next_out = reinterpret_cast<Bytef*>(target);
    stream_.avail_out = static_cast<uInt>(count);
    status = ::inflate(&stream_, Z_NO_FLUSH);
    left_.remove_prefix(given - stream_.avail_in);
    return count - stream_.avail_out;
  }

  void begin_member() { ::inflateReset(&stream_); }
  std::string_view left() const { return left_; }
  /// What zlib has to say of an error.
  std::string message() const { return stream_.msg != nullptr ? stream_.msg : "no valid data"; }

 private:
  z_stream stream_{};
  std::string_view left_;  ///< not decompressed yet
};

class Deflater {
 public:
  Deflater() {
    constexpr int level = 6;
    constexpr int default_memory = 8;
    if (::deflateInit2(&stream_, level, Z_DEFLATED, -window_bits, default_memory, Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() { ::deflateEnd(&stream_); }

  /// Appends the bytes from `begin` on, `count` of them, in a form that the next block can follow, or that ends the
  /// stream where they are the last.
  void append(std::string_view bytes, std::size_t begin, std::size_t count, MemoryBlock& target) {
    const std::size_t dictionary = std::min(begin, std::size_t{1} << window_bits);
    if (dictionary > 0) {
      ::deflateSetDictionary(&stream_, bytes_at(bytes, begin - dictionary), static_cast<uInt>(dictionary));
    }
    constexpr std::size_t of_the_flush = 64;
    const std::size_t room = ::deflateBound(&stream_, static_cast<uLong>(count)) + of_the_flush;
    const std::size_t before = target.size();
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib only reads them
    stream_.next_in = const_cast<Bytef*>(bytes_at(bytes, begin));
    stream_.avail_in = static_cast<uInt>(count);
    stream_.next_out = reinterpret_cast<Bytef*>(target.extend(room));
    stream_.avail_out = static_cast<uInt>(room);
    const bool is_last = begin + count == bytes.size();
    const int status = ::deflate(&stream_, is_last ? Z_FINISH : Z_SYNC_FLUSH);
    if (status != (is_last ? Z_STREAM_END : Z_OK) || stream_.avail_out == 0) {
      throw std::logic_error("zlib needs more room than it says");
    }
    target.truncate(before + room - stream_.avail_out);
  }

  static const Bytef* bytes_at(std::string_view bytes, std::size_t begin) {
    return reinterpret_cast<const Bytef*>(bytes.data()) + begin;
  }

 private:
  z_stream stream_{};
};

/// Little-endian.
std::array<char, 4> four_bytes(std::uint64_t number) {
  std::array<char, 4> bytes{};
  for (char& byte : bytes) {
    byte = static_cast<char>(number & 0xFFU);
    number >>= 8U;
  }
  return bytes;
}

}  // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

MemoryBlock gunzip(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::size_t step = std::size_t{1} << 20;
  Inflater inflater(bytes);
  MemoryBlock block;
  const auto fail = [&](const std::string& what) {
    throw ReadError(path, "compressed byte " + std::to_string(bytes.size() - inflater.left().size()) + ": " + what);
  };
  for (;;) {
    const std::size_t before = block.size();
    int status = Z_OK;
    const std::size_t got = inflater.inflate(block.extend(step), step, status);
    block.truncate(before + got);
    if (status == Z_STREAM_END) {
      if (inflater.left().empty()) {
        return block;
      }
      if (!is_gzip(inflater.left())) {
        fail("bytes follow the end of the gzip data");
      }
      inflater.begin_member();
    } else if (status == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      fail("the gzip data is damaged (" + inflater.message() + ")");
    } else if (got < step && inflater.left().empty()) {
      fail("the gzip data ends too early: the file is cut off");
    }
  }
}

void write_gzip(std::string_view bytes, const ByteSink& sink, const FileWorkers& workers) {
  using namespace std::string_view_literals;
  constexpr std::size_t part_bytes = std::size_t{1} << 18;
  const std::size_t blocks = std::max(std::size_t{1}, (bytes.size() + part_bytes - 1) / part_bytes);
  std::vector<uLong> sums(blocks);
  sink("\x1f\x8b\x08\0\0\0\0\0\0\xff"sv);  // deflate, nothing optional, no time, of no system in particular
  OrderedBlocks(sink, workers).write(blocks, [&](std::size_t block, MemoryBlock& target) {
    const std::size_t begin = block * part_bytes;
    const std::size_t count = std::min(part_bytes, bytes.size() - begin);
    sums[block] = ::crc32(0, Deflater::bytes_at(bytes, begin), static_cast<uInt>(count));
    Deflater().append(bytes, begin, count, target);
  });
  uLong sum = sums.front();
  for (std::size_t block = 1; block < blocks; ++block) {
    const std::size_t count = std::min(part_bytes, bytes.size() - block * part_bytes);
    sum = ::crc32_combine(sum, sums[block], static_cast<z_off_t>(count));
  }
  for (const std::uint64_t number : {std::uint64_t{sum}, std::uint64_t{bytes.size()}}) {
    const std::array<char, 4> last = four_bytes(number);
    sink({last.data(), last.size()});
  }
}

}  // namespace trismooth
