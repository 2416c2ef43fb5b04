// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an OBJ text, in parts, by all workers, where every statement is on a line of its own and nothing stands behind
/// it: no continued lines, no comments but on lines of their own, numbers as PlainNumbers reads them. Nothing where the
/// text has anything else in it, or is broken: others read it then, and say what is wrong. Two passes over the text:
/// one counts, one reads. Memory beside the result: a view for every usemtl and g.
std::optional<std::pair<MeshDocument, NumberSites>> read_plain_obj(std::string_view text, const FileWorkers& workers);

}  // namespace trismooth
