// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/medit/medit_binary_reader.h"
#include "trismooth/mesh_io/medit/medit_content.h"
#include "trismooth/mesh_io/medit/medit_keywords.h"
#include "trismooth/mesh_io/medit/medit_reader.h"
#include "trismooth/mesh_io/medit/medit_writer.h"
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

std::vector<std::string> lost_in_medit(const MeshDocument& document) {
  return MeditContent(document).losses();
}

bool is_medit(std::string_view bytes) {
  if (medit_byte_order(bytes)) {
    return true;
  }
  TextScanner scanner(text_head(bytes), {}, TextScanner::Comments::hash);
  const MeditKeyword* const keyword = find_medit_keyword(scanner.peek_token());
  return keyword != nullptr && keyword->role == MeditRole::version;
}

}  // namespace

const Codec medit_codec{
    {FileFormat::medit, "medit", "Medit", {".mesh", ".meshb"}, {.names = true, .eight_node_quads = false}, 1},
    &read_medit,
    &write_medit,
    &lost_in_medit,
    &is_medit};

}  // namespace trismooth
