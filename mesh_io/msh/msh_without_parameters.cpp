// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_without_parameters.h"

#include <algorithm>
#include <cstdint>

#include "trismooth/mesh_io/msh/msh_excerpt.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

namespace {

std::size_t end_of_msh_token(std::string_view bytes, std::size_t begin) {
  while (begin < bytes.size() && !is_white_space(bytes[begin])) {
    ++begin;
  }
  return begin;
}

/// Behind the number of a file.
std::size_t end_of_msh_number(std::string_view bytes, std::size_t begin, std::size_t size_in_binary, bool binary) {
  return binary ? begin + size_in_binary : end_of_msh_token(bytes, begin);
}

void leave_out_of_blocks(std::string_view bytes, const MshLayout& layout, const std::vector<bool>& left_out,
                         MshExcerpt& excerpt) {
  const bool binary = layout.header.binary;
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    if (!left_out[i]) {
      continue;
    }
    const MshNodeList& list = layout.nodes[i];
    const std::size_t flag = list.parametric.flag_offset;
    excerpt.copy_until(flag);
    excerpt.pass(end_of_msh_number(bytes, flag, sizeof(std::int32_t), binary),
                 binary ? std::string_view("\0\0\0\0", sizeof(std::int32_t)) : std::string_view("0"));
    const std::size_t columns = list.sites.columns.size();
    for (std::size_t node = 0; node < list.size(); ++node) {
      const std::uint64_t* const offsets = list.sites.offsets.data() + node * columns;
      excerpt.copy_until(end_of_msh_number(bytes, offsets[2], sizeof(double), binary));
      excerpt.pass(end_of_msh_number(bytes, offsets[columns - 1], sizeof(double), binary));
    }
  }
}

/// $ParametricNodes of version 2: rows of a tag, x, y, z, a dimension, an entity and the parameters.
void leave_out_of_list(std::string_view bytes, const MshLayout& layout, MshExcerpt& excerpt) {
  const bool binary = layout.header.binary;
  constexpr std::string_view word = "Parametric";
  const auto pass_word = [&](std::size_t from) {
    const std::size_t at = bytes.find(word, from);
    excerpt.copy_until(at);
    excerpt.pass(at + word.size());
  };
  const bool is_named = layout.header.version >= 20;  // $NOD of version 1 does not say what is in it
  if (is_named) {
    pass_word(layout.nodes_begin);
  }
  for (const MshNodeList& list : layout.nodes) {
    const std::size_t columns = list.sites.columns.size();
    for (std::size_t node = 0; node < list.size(); ++node) {
      const std::uint64_t* const offsets = list.sites.offsets.data() + node * columns;
      const std::size_t end_of_z = end_of_msh_number(bytes, offsets[2], sizeof(double), binary);
      excerpt.copy_until(end_of_z);
      if (binary) {
        excerpt.pass(end_of_z + 2 * sizeof(std::int32_t) + (columns - 3) * sizeof(double));
        continue;
      }
      PlainNumbers numbers(bytes, end_of_z);
      numbers.skip(2 + columns - 3);
      excerpt.pass(end_of_msh_token(bytes, numbers.token_offset()));
    }
  }
  if (is_named) {
    pass_word(bytes.rfind('$', layout.nodes_end));
  }
}

}  // namespace

std::string without_msh_parameters(std::string_view bytes, const MshLayout& layout, const std::vector<bool>& left_out) {
  MshExcerpt excerpt(bytes);
  if (layout.header.version >= 40) {
    leave_out_of_blocks(bytes, layout, left_out, excerpt);
  } else {
    leave_out_of_list(bytes, layout, excerpt);
  }
  return excerpt.finish();
}

}  // namespace trismooth
