// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ranges/msh_range.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/msh/msh_blocks.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_reader.h"

namespace trismooth {

namespace {

/// Of what is in both.
NumberRange common(NumberRange a, NumberRange b) {
  const std::uint64_t first = std::max(a.first, b.first);
  return {first, std::max(first, std::min(a.last, b.last))};
}

std::uint64_t count_of(NumberRange range) {
  return range.last - range.first;
}

}  // namespace

class MshRanges::Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : blocks_(path) {
    first_node_ = point_count() > 0 ? blocks_.tag_at(blocks_.nodes().front().tags) : 0;
    first_element_ = cell_count() > 0 ? blocks_.tag_at(blocks_.elements().front().rows) : 0;
  }

  std::uint64_t point_count() const { return blocks_.point_count(); }
  std::uint64_t cell_count() const { return blocks_.cell_count(); }
  bool may_repeat_elements() const { return !blocks_.is_4(); }

  MeshDocument read(NumberRange points, NumberRange cells, const FileWorkers& workers) const {
    // Elements of the file that is made of the range all have its first node, so it needs one.
    const bool has_points = points.first < points.last;
    const NumberRange nodes = has_points ? points : NumberRange{0, 1};
    if (point_count() == 0 || points.last > point_count() || cells.last > cell_count()) {
      blocks_.give_up("it has not these points and cells");
    }
    MemoryBlock made;
    append(made, blocks_.head());
    append_nodes(made, nodes);
    std::vector<std::int32_t> corners;
    append_elements(made, cells, first_node_ + static_cast<std::int64_t>(nodes.first), corners);
    MshLayout layout;
    const FileBytes bytes(std::move(made));
    MeshDocument document = read_msh(blocks_.file().path(), bytes, workers, layout);
    if (document.cells.size() != count_of(cells) || document.cells.connectivity.size() != corners.size() ||
        !document.cell_sets.empty()) {
      blocks_.give_up("it lists elements again");
    }
    document.cells.connectivity = std::move(corners);
    if (!has_points) {
      document.points.clear();
    }
    set_implied_sets(document, points);
    return document;
  }

 private:
  static void append(MemoryBlock& made, std::string_view bytes) {
    if (!bytes.empty()) {
      std::memcpy(made.extend(bytes.size()), bytes.data(), bytes.size());
    }
  }

  template <class T>
  void append_number(MemoryBlock& made, T value) const {
    store(made.extend(sizeof(T)), value);
  }

  /// In the byte order of the file.
  template <class T>
  void store(std::byte* target, T value) const {
    std::memcpy(target, &value, sizeof(T));
    if (blocks_.header().swapped) {
      std::reverse(target, target + sizeof(T));
    }
  }

  void append_tag(MemoryBlock& made, std::int64_t tag) const {
    if (blocks_.is_4()) {
      append_number(made, tag);
    } else {
      append_number(made, static_cast<std::int32_t>(tag));
    }
  }

  FileBytes rows_of(std::uint64_t begin, std::uint64_t first, std::uint64_t count, std::size_t row_bytes) const {
    FileBytes bytes = blocks_.file().read_range(begin + first * row_bytes, begin + (first + count) * row_bytes);
    if (bytes.size() != count * row_bytes) {
      blocks_.give_up("it is cut off");
    }
    return bytes;
  }

  /// Throws unless the tags, one in every `step` bytes, count on from `tag`.
  void require_run(std::string_view bytes, std::size_t step, std::int64_t tag) const {
    for (std::size_t at = 0; at < bytes.size(); at += step, ++tag) {
      BinaryNumbers numbers(bytes, at, blocks_.header().swapped);
      std::int64_t found = 0;
      std::int32_t narrow = 0;
      const bool is_read = blocks_.is_4() ? numbers.next(found) : numbers.next(narrow);
      if (!is_read || (blocks_.is_4() ? found : narrow) != tag) {
        blocks_.give_up("its tags do not count on");
      }
    }
  }

  void append_nodes(MemoryBlock& made, NumberRange range) const {
    append(made, "$Nodes\n");
    MemoryBlock blocks;
    std::int64_t block_count = 0;
    for (const MshNodeBlock& block : blocks_.nodes()) {
      const NumberRange here = common(range, block.numbers);
      const std::uint64_t count = count_of(here);
      if (count == 0) {
        continue;
      }
      ++block_count;
      const std::uint64_t first = here.first - block.numbers.first;
      const std::int64_t tag = first_node_ + static_cast<std::int64_t>(here.first);
      const FileBytes rows = rows_of(block.rows, first, count, block.row_bytes);
      if (blocks_.is_4()) {
        const FileBytes tags = rows_of(block.tags, first, count, blocks_.tag_size());
        require_run(tags, blocks_.tag_size(), tag);
        append_number(blocks, block.dimension);
        append_number(blocks, block.entity);
        append_number(blocks, block.parametric);
        append_number(blocks, static_cast<std::int64_t>(count));
        append(blocks, tags);
      } else {
        require_run(rows, block.row_bytes, tag);
      }
      append(blocks, rows);
    }
    append_counts(made, block_count, static_cast<std::int64_t>(count_of(range)));
    append(made, {reinterpret_cast<const char*>(blocks.data()), blocks.size()});
    append(made, "\n$EndNodes\n");
  }

  void append_counts(MemoryBlock& made, std::int64_t blocks, std::int64_t count) const {
    if (!blocks_.is_4()) {
      append(made, std::to_string(count) + "\n");
      return;
    }
    append_number(made, blocks);
    append_number(made, count);
    append_number(made, std::int64_t{1});
    append_number(made, count);
  }

  /// With that node as all corners; those that they have go to `corners`.
  void append_elements(MemoryBlock& made, NumberRange range, std::int64_t node,
                       std::vector<std::int32_t>& corners) const {
    append(made, "$Elements\n");
    const std::ptrdiff_t block_count = std::ranges::count_if(
        blocks_.elements(), [&](const MshElementBlock& block) { return count_of(common(range, block.numbers)) > 0; });
    append_counts(made, block_count, static_cast<std::int64_t>(count_of(range)));
    for (const MshElementBlock& block : blocks_.elements()) {
      const NumberRange here = common(range, block.numbers);
      const std::uint64_t count = count_of(here);
      if (count == 0) {
        continue;
      }
      if (blocks_.is_4()) {
        append_number(made, block.dimension);
        append_number(made, block.entity);
        append_number(made, block.type);
        append_number(made, static_cast<std::int64_t>(count));
      } else {
        append_number(made, block.type);
        append_number(made, static_cast<std::int32_t>(count));
        append_number(made, block.labels);
      }
      const FileBytes rows = rows_of(block.rows, here.first - block.numbers.first, count, block.row_bytes);
      require_run(rows, block.row_bytes, first_element_ + static_cast<std::int64_t>(here.first));
      append_rows(made, rows, block, node, corners);
    }
    append(made, "\n$EndElements\n");
  }

  void append_rows(MemoryBlock& made, std::string_view rows, const MshElementBlock& block, std::int64_t node,
                   std::vector<std::int32_t>& corners) const {
    const MshElementType& type = msh_element_type(block.type);
    const std::size_t front = block.row_bytes - type.vertices * blocks_.tag_size();
    for (std::size_t at = 0; at < rows.size(); at += block.row_bytes) {
      append(made, rows.substr(at, front));
      BinaryNumbers numbers(rows, at + front, blocks_.header().swapped);
      const std::size_t first = corners.size();
      corners.resize(first + type.vertices);
      for (std::size_t i = 0; i < type.vertices; ++i) {
        std::int64_t tag = 0;
        std::int32_t narrow = 0;
        const bool is_read = blocks_.is_4() ? numbers.next(tag) : numbers.next(narrow);
        const std::uint64_t corner =
            static_cast<std::uint64_t>(blocks_.is_4() ? tag : narrow) - static_cast<std::uint64_t>(first_node_);
        if (!is_read || corner >= point_count()) {
          blocks_.give_up("an element has a node that is not there");
        }
        corners[first + (type.places.empty() ? i : type.places[i])] = static_cast<std::int32_t>(corner);
        append_tag(made, node);
      }
    }
  }

  /// Those of the points of the range, as the whole file has them.
  void set_implied_sets(MeshDocument& document, NumberRange points) const {
    document.implied_sets.clear();
    if (!blocks_.has_surfaces()) {
      return;
    }
    for (const std::int32_t dimension : {0, 1}) {
      std::vector<std::int32_t> members;
      for (const MshNodeBlock& block : blocks_.nodes()) {
        const NumberRange here = common(points, block.numbers);
        for (std::uint64_t p = here.first; p < here.last && block.dimension == dimension; ++p) {
          members.push_back(static_cast<std::int32_t>(p - points.first));
        }
      }
      if (!members.empty()) {
        document.implied_sets.push_back(
            {std::string(dimension == 0 ? points_of_geometry : curves_of_geometry), std::move(members)});
      }
    }
  }

  MshBlocks blocks_;
  std::int64_t first_node_ = 0;
  std::int64_t first_element_ = 0;
};

MshRanges::MshRanges(const std::filesystem::path& path) : reader_(std::make_unique<Reader>(path)) {}
MshRanges::~MshRanges() = default;

std::uint64_t MshRanges::point_count() const {
  return reader_->point_count();
}

std::uint64_t MshRanges::cell_count() const {
  return reader_->cell_count();
}

bool MshRanges::may_repeat_elements() const {
  return reader_->may_repeat_elements();
}

MeshDocument MshRanges::read(NumberRange points, NumberRange cells, const FileWorkers& workers) const {
  return reader_->read(points, cells, workers);
}

}  // namespace trismooth
