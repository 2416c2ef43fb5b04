// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/input_file.h"
#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/ranges/number_range.h"

namespace trismooth {

/// Of nodes of one entity; a list of version 2 is one.
struct MshNodeBlock {
  std::int32_t dimension = -1;
  std::int32_t entity = 0;
  std::int32_t parametric = 0;
  NumberRange numbers{};   ///< of the points
  std::uint64_t tags = 0;  ///< where they begin in the file; of version 2 they are in the rows
  std::uint64_t rows = 0;  ///< where rows begin
  std::size_t row_bytes = 0;
};

/// Of elements of one type.
struct MshElementBlock {
  std::int32_t dimension = 0;
  std::int32_t entity = 0;
  std::int32_t type = 0;
  std::int32_t labels = 0;  ///< of version 2: numbers between an element's tag and its nodes
  NumberRange numbers{};    ///< of the cells
  std::uint64_t rows = 0;
  std::size_t row_bytes = 0;
};

/// Where the blocks of a binary MSH file lie that can be read by ranges (MshRanges). Reads their heads alone.
class MshBlocks {
 public:
  /// Throws ReadError for other files.
  explicit MshBlocks(const std::filesystem::path& path);

  const InputFile& file() const { return file_; }
  const MshHeader& header() const { return header_; }
  bool is_4() const { return header_.version >= 40; }
  std::size_t tag_size() const { return is_4() ? sizeof(std::int64_t) : sizeof(std::int32_t); }

  /// What stands before the nodes.
  const std::string& head() const { return head_; }
  std::uint64_t point_count() const { return points_; }
  std::uint64_t cell_count() const { return cells_; }
  /// Those that hold something, in the order of the file.
  const std::vector<MshNodeBlock>& nodes() const { return nodes_; }
  const std::vector<MshElementBlock>& elements() const { return elements_; }
  /// Whether there are nodes of surfaces or volumes.
  bool has_surfaces() const { return has_surfaces_; }

  /// The number that stands there; throws where the file ends before.
  template <class T>
  T number_at(std::uint64_t offset) const {
    const FileBytes bytes = file_.read_range(offset, offset + sizeof(T));
    T value{};
    if (!BinaryNumbers(bytes, 0, header_.swapped).next(value)) {
      give_up("it is cut off");
    }
    return value;
  }
  std::int64_t tag_at(std::uint64_t offset) const {
    return is_4() ? number_at<std::int64_t>(offset) : number_at<std::int32_t>(offset);
  }

  /// Throws ReadError.
  [[noreturn]] void give_up(const char* what) const;

 private:
  void read_head();
  void parse_head(std::string_view bytes);
  std::uint64_t text_count();
  std::uint64_t next_size();
  std::int32_t next_int();
  void pass(std::uint64_t count, std::size_t row_bytes);
  void read_node_blocks();
  void read_element_blocks();
  void pass_section(std::string_view end, std::string_view begin);

  InputFile file_;
  MshHeader header_;
  std::string head_;
  std::uint64_t at_ = 0;
  std::uint64_t points_ = 0;
  std::uint64_t cells_ = 0;
  std::vector<MshNodeBlock> nodes_;
  std::vector<MshElementBlock> elements_;
  bool has_surfaces_ = false;
};

}  // namespace trismooth
