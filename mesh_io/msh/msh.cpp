// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string_view>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/msh/msh_original.h"
#include "trismooth/mesh_io/msh/msh_writer.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// The first line that is not empty names a section; $Comments may stand before the header.
bool is_msh(std::string_view bytes) {
  std::size_t begin = begin_of_text(bytes);
  begin = std::min(bytes.find_first_not_of(" \t\v\f\r\n", begin), bytes.size());
  const std::string_view line = trimmed(bytes.substr(begin, find_line_end(bytes, begin) - begin));
  return line == "$MeshFormat" || line == "$NOD" || line == "$Comments";
}

}  // namespace

const Codec msh_codec{{FileFormat::msh, "msh", "Gmsh MSH", {".msh"}, {.arrays = true, .names = true}},
                      &read_msh_file,
                      &write_msh,
                      &lost_in_msh,
                      &is_msh};

}  // namespace trismooth
