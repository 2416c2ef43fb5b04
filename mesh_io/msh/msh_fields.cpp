// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_fields.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "trismooth/mesh_io/text/text_block.h"

namespace trismooth {

namespace {

/// Numbers of a row, as text or binary.
class MshRowNumbers {
 public:
  MshRowNumbers(const MshHeader& header, MemoryBlock& bytes) : header_(header), bytes_(bytes) {}

  /// In binary files as a T.
  template <class T>
  void append(T value, char separator) {
    if (!header_.binary) {
      TextBlock(bytes_).number(value).text(separator);
      return;
    }
    auto stored = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if (header_.swapped) {
      std::ranges::reverse(stored);
    }
    std::memcpy(bytes_.extend(sizeof(T)), stored.data(), sizeof(T));
  }

  void append_tag(std::int64_t tag) {
    if (header_.binary) {
      append(static_cast<std::int32_t>(tag), ' ');
    } else {
      append(tag, ' ');
    }
  }

 private:
  const MshHeader& header_;
  MemoryBlock& bytes_;
};

}  // namespace

std::size_t msh_components(const DataArray& array) {
  switch (array.components) {
    case 1:
    case 3:
    case 9:
      return array.components;
    case 2:
      return 3;
    default:
      return 0;
  }
}

std::string plain_msh_name(std::string_view name) {
  std::string plain(name);
  std::ranges::replace_if(
      plain, [](char c) { return c == '"' || static_cast<unsigned char>(c) < ' '; }, '_');
  return plain;
}

std::string quoted_msh_name(std::string_view name) {
  return '"' + plain_msh_name(name) + '"';
}

void write_msh_field(OrderedBlocks& blocks, const MshHeader& header, const MshFieldRows& rows, const DataArray& array) {
  const std::size_t components = msh_components(array);
  if (components == 0) {
    return;
  }
  const std::string section = rows.of_nodes ? "NodeData" : "ElementData";
  // One text, the name; one real number, the time; a step and two sizes.
  blocks.write("$" + section + "\n1\n" + quoted_msh_name(array.name) + "\n1\n0\n3\n0\n" + std::to_string(components) +
               "\n" + std::to_string(rows.size) + "\n");
  constexpr std::size_t number_bytes = 20;
  blocks.write_rows(
      rows.size, (1 + components) * number_bytes, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
        MshRowNumbers numbers(header, bytes);
        for (std::size_t i = begin; i < end; ++i) {
          numbers.append_tag(rows.tags.empty() ? static_cast<std::int64_t>(i + 1) : rows.tags[i]);
          const std::size_t row = rows.places.empty() ? i : static_cast<std::size_t>(rows.places[i]);
          for (std::size_t k = 0; k < components; ++k) {
            numbers.append(k < array.components ? array.value(row, k) : 0.0, k + 1 < components ? ' ' : '\n');
          }
        }
      });
  // Gmsh looks for the end behind an end of line.
  blocks.write((header.binary ? "\n$End" : "$End") + section + "\n");
}

}  // namespace trismooth
