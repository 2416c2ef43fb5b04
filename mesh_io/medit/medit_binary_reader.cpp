// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_binary_reader.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

constexpr std::size_t medit_word_bytes = 4;
constexpr std::size_t medit_head_bytes = 3 * medit_word_bytes;  // up to the first keyword

bool is_swapped_medit(NumberEncoding byte_order) {
  return (byte_order == NumberEncoding::big_endian) == (std::endian::native == std::endian::little);
}

class MeditBinaryReader {
 public:
  MeditBinaryReader(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers)
      : path_(path),
        bytes_(bytes),
        workers_(workers),
        byte_order_(medit_byte_order(bytes).value_or(NumberEncoding::little_endian)),
        swapped_(is_swapped_medit(byte_order_)),
        mesh_(workers) {}

  MeditMesh read() {
    version_ = read_integer(medit_word_bytes, medit_word_bytes);
    real_bytes_ = version_ == 1 ? sizeof(float) : sizeof(double);
    find_blocks();
    read_head();
    for (const MeditRole role : {MeditRole::vertices, MeditRole::cells, MeditRole::cell_set}) {
      for (const Block& block : blocks_) {
        if (block.keyword != nullptr && group_of(block.keyword->role) == role) {
          read_block(block);
        }
      }
    }
    if (!mesh_.has_vertices) {
      fail(bytes_.size(), "expected the keyword Vertices, got the end of the file");
    }
    mesh_.sites.encoding = byte_order_;
    if (const auto wrong = mesh_.finish()) {
      fail(wrong->set->place + wrong->index * integer_bytes(),
           std::string(wrong->set->keyword->name) + ": expected a number from 1 to that of the " +
               std::string(wrong->things) + ", " + std::to_string(wrong->count) + ", got " +
               std::to_string(wrong->set->numbers[wrong->index]));
    }
    return std::move(mesh_);
  }

 private:
  /// What stands behind a keyword and the position of the next one.
  struct Block {
    const MeditKeyword* keyword;  ///< null: unknown
    std::size_t begin;
    std::size_t end;
  };

  static MeditRole group_of(MeditRole role) { return role == MeditRole::vertex_set ? MeditRole::cell_set : role; }

  std::size_t integer_bytes() const { return version_ < 4 ? sizeof(std::int32_t) : sizeof(std::int64_t); }
  std::size_t position_bytes() const { return version_ < 3 ? sizeof(std::uint32_t) : sizeof(std::uint64_t); }

  std::int64_t read_integer(std::size_t offset, std::size_t bytes) const {
    BinaryNumbers numbers(bytes_, offset, swapped_);
    return bytes == medit_word_bytes ? next<std::int32_t>(numbers) : next<std::int64_t>(numbers);
  }

  /// There are as many bytes.
  template <class Stored>
  static std::int64_t next(BinaryNumbers& numbers) {
    Stored value{};
    numbers.next(value);
    return static_cast<std::int64_t>(value);
  }

  void find_blocks() {
    std::size_t offset = 2 * medit_word_bytes;
    while (offset < bytes_.size() && !mesh_.has_end) {
      const std::size_t begin = offset + medit_word_bytes + position_bytes();
      if (begin > bytes_.size()) {
        fail(offset, "expected a keyword and the position of the next one, got the end of the file: it is cut off");
      }
      const auto code = static_cast<std::int32_t>(read_integer(offset, medit_word_bytes));
      const MeditKeyword* const keyword = find_medit_keyword(code);
      BinaryNumbers numbers(bytes_, offset + medit_word_bytes, swapped_);
      const std::uint64_t next_position = version_ < 3 ? static_cast<std::uint64_t>(next<std::uint32_t>(numbers))
                                                       : static_cast<std::uint64_t>(next<std::uint64_t>(numbers));
      if (next_position != 0 && (next_position < begin || next_position > bytes_.size())) {
        fail(offset + medit_word_bytes, "expected the position of the next keyword, from " + std::to_string(begin) +
                                            " to the file's size, " + std::to_string(bytes_.size()) + ", got " +
                                            std::to_string(next_position) + ": the file is cut off, or that is wrong");
      }
      const bool is_last = next_position == 0;
      const Block block{keyword, begin, is_last ? bytes_.size() : static_cast<std::size_t>(next_position)};
      const bool is_known = keyword != nullptr && keyword->role != MeditRole::other;
      if (is_known && !mesh_.begin_section(*keyword)) {
        fail(offset, "a second " + std::string(keyword->name));
      }
      if (is_known && keyword->role == MeditRole::unsupported) {
        fail(offset, std::string(keyword->name) + " are not read");
      }
      if (is_known && keyword->role == MeditRole::end) {
        mesh_.has_end = true;
        if (begin < bytes_.size()) {
          mesh_.add_other("what follows End");
        }
        break;
      }
      if (!is_known) {
        mesh_.add_other(keyword != nullptr ? std::string(keyword->name) : "keyword " + std::to_string(code));
      }
      blocks_.push_back(block);
      last_is_open_ = is_last;
      offset = block.end;
    }
  }

  /// The dimension, which stands first, and the size of coordinates.
  void read_head() {
    const Block& first = blocks_.front();
    if (first.end - first.begin != medit_word_bytes) {
      fail(first.begin,
           "expected the dimension and nothing else, got " + std::to_string(first.end - first.begin) + " bytes");
    }
    const std::int64_t dimension = read_integer(first.begin, medit_word_bytes);
    if (dimension != 2 && dimension != 3) {
      fail(first.begin, "expected a dimension of 2 or 3, got " + std::to_string(dimension));
    }
    mesh_.set_dimension(static_cast<std::size_t>(dimension));
    for (const Block& block : blocks_) {
      if (block.keyword != nullptr && block.keyword->role == MeditRole::precision) {
        constexpr std::int64_t single_bits = 32;
        constexpr std::int64_t double_bits = 64;
        const std::int64_t bits =
            block.end - block.begin < integer_bytes() ? 0 : read_integer(block.begin, integer_bytes());
        if (bits != single_bits && bits != double_bits) {
          fail(block.begin, "expected a precision of 32 or 64 bits");
        }
        real_bytes_ = bits == single_bits ? sizeof(float) : sizeof(double);
      }
    }
    if (real_bytes_ == sizeof(float)) {
      mesh_.document.point_type = mesh_.sites.type = ScalarType::float32;
    }
  }

  /// The rows that the block declares; they fill it.
  std::size_t read_count(const Block& block, std::size_t row_bytes) const {
    const std::size_t size = block.end - block.begin;
    const std::string name(block.keyword->name);
    if (size < integer_bytes()) {
      fail(block.begin, "expected the number of " + name + ", got " + std::to_string(size) + " bytes");
    }
    const std::int64_t count = read_integer(block.begin, integer_bytes());
    const std::size_t room = (size - integer_bytes()) / row_bytes;
    const bool is_open = last_is_open_ && &block == &blocks_.back();
    const bool fits =
        count >= 0 && static_cast<std::uint64_t>(count) <= room && count <= std::numeric_limits<std::int32_t>::max();
    if (!fits || (!is_open && static_cast<std::size_t>(count) * row_bytes + integer_bytes() != size)) {
      fail(block.begin, "declares " + std::to_string(count) + " " + name + ", but there is room for " +
                            std::to_string(room) + " up to the next keyword");
    }
    return static_cast<std::size_t>(count);
  }

  void read_block(const Block& block) {
    switch (block.keyword->role) {
      case MeditRole::vertices:
        real_bytes_ == sizeof(float) ? read_vertices<float>(block) : read_vertices<double>(block);
        break;
      case MeditRole::cells:
        version_ < 4 ? read_cells<std::int32_t>(block) : read_cells<std::int64_t>(block);
        break;
      default:
        read_set(block);
    }
  }

  template <class Real>
  void read_vertices(const Block& block) {
    const std::size_t dimension = mesh_.dimension();
    const std::size_t row_bytes = dimension * sizeof(Real) + integer_bytes();
    const std::size_t count = read_count(block, row_bytes);
    const std::size_t begin = block.begin + integer_bytes();
    mesh_.resize_vertices(count);
    const auto read_row = [&](std::size_t vertex) {
      BinaryNumbers numbers(bytes_, begin + vertex * row_bytes, swapped_);
      bool finite = true;
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        Real coordinate = 0;
        numbers.next(coordinate);
        finite = finite && std::isfinite(coordinate);
        mesh_.document.points[3 * vertex + axis] = static_cast<double>(coordinate);
        mesh_.sites.offsets[dimension * vertex + axis] = numbers.token_offset();
      }
      mesh_.vertex_refs[vertex] = version_ < 4 ? next<std::int32_t>(numbers) : next<std::int64_t>(numbers);
      return finite;
    };
    if (const auto wrong = first_wrong_row(count, row_bytes, read_row)) {
      fail(begin + *wrong * row_bytes,
           "vertex " + std::to_string(*wrong + 1) + " has a coordinate that is not a finite number");
    }
  }

  template <class Integer>
  void read_cells(const Block& block) {
    const MeditKeyword& keyword = *block.keyword;
    const std::size_t row_bytes = (keyword.vertices + 1) * sizeof(Integer);
    const std::size_t count = read_count(block, row_bytes);
    const std::size_t begin = block.begin + sizeof(Integer);
    mesh_.append_cells(keyword, count);
    const auto corners = std::span(mesh_.document.cells.connectivity).last(count * keyword.vertices);
    const auto references = std::span(mesh_.cell_refs).last(count);
    const auto vertices = static_cast<Integer>(mesh_.document.point_count());
    const auto read_row = [&](std::size_t cell) {
      BinaryNumbers numbers(bytes_, begin + cell * row_bytes, swapped_);
      bool in_range = true;
      for (std::int32_t& corner : corners.subspan(cell * keyword.vertices, keyword.vertices)) {
        Integer number = 0;
        numbers.next(number);
        in_range = in_range && number >= 1 && number <= vertices;
        corner = in_range ? static_cast<std::int32_t>(number - 1) : 0;
      }
      references[cell] = next<Integer>(numbers);
      return in_range;
    };
    if (const auto wrong = first_wrong_row(count, row_bytes, read_row)) {
      fail(begin + *wrong * row_bytes, "row " + std::to_string(*wrong + 1) + " of " + std::string(keyword.name) +
                                           " has a vertex number out of range; the file has " +
                                           std::to_string(vertices) + " vertices, counted from 1");
    }
  }

  /// Calls read_row(row) for all rows, on all workers; the first for which it is false.
  template <class ReadRow>
  std::optional<std::size_t> first_wrong_row(std::size_t count, std::size_t row_bytes, const ReadRow& read_row) {
    const bool all = all_file_blocks(workers_, count, row_bytes, [&](std::size_t first, std::size_t last) {
      bool right = true;
      for (std::size_t row = first; row < last && right; ++row) {
        right = read_row(row);
      }
      return right;
    });
    for (std::size_t row = 0; row < count && !all; ++row) {
      if (!read_row(row)) {
        return row;
      }
    }
    return std::nullopt;
  }

  void read_set(const Block& block) {
    const std::size_t count = read_count(block, integer_bytes());
    MeditMesh::Set set{block.keyword, block.begin + integer_bytes(), std::vector<std::int64_t>(count)};
    for (std::size_t i = 0; i < count; ++i) {
      set.numbers[i] = read_integer(set.place + i * integer_bytes(), integer_bytes());
    }
    mesh_.add_set(std::move(set));
  }

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    throw ReadError(path_, "byte " + std::to_string(offset) + ": " + message);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  FileWorkers workers_;
  NumberEncoding byte_order_;
  bool swapped_;  ///< numbers are not in this machine's byte order
  std::int64_t version_ = 0;
  std::size_t real_bytes_ = 0;
  std::vector<Block> blocks_;
  bool last_is_open_ = false;  ///< the last block does not say where it ends
  MeditMesh mesh_;
};

}  // namespace

std::optional<NumberEncoding> medit_byte_order(std::string_view bytes) {
  constexpr std::int32_t newest_version = 4;
  if (bytes.size() < medit_head_bytes) {
    return std::nullopt;
  }
  for (const NumberEncoding order : {NumberEncoding::little_endian, NumberEncoding::big_endian}) {
    BinaryNumbers numbers(bytes, 0, is_swapped_medit(order));
    std::int32_t one = 0;
    std::int32_t version = 0;
    std::int32_t keyword = 0;
    if (numbers.next(one) && numbers.next(version) && numbers.next(keyword) && one == 1 && version >= 1 &&
        version <= newest_version && keyword == medit_code::dimension) {
      return order;
    }
  }
  return std::nullopt;
}

MeditMesh read_medit_binary(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers) {
  return MeditBinaryReader(path, bytes, workers).read();
}

}  // namespace trismooth
