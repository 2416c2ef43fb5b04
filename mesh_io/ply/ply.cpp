// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ply/ply.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/text_head.h"

namespace trismooth {

namespace {

/// By the first line, and one that says anything of the file behind it.
bool is_ply(std::string_view bytes) {
  constexpr std::array<std::string_view, 4> statements{"format", "comment", "obj_info", "element"};
  TextScanner scanner(text_head(bytes), {});
  return trimmed(scanner.next_line()) == "ply" &&
         std::ranges::find(statements, scanner.peek_token()) != statements.end();
}

}  // namespace

const Codec ply_codec{{FileFormat::ply, "ply", "PLY", {".ply"}, {.arrays = true, .curved_cells = false}},
                      &read_ply,
                      &write_ply,
                      &what_ply_loses,
                      &is_ply};

}  // namespace trismooth
