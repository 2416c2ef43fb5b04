// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "trismooth/mesh_io/inp/inp_source.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The original of an input file. The first of the sources is written byte by byte, with new coordinates in their
/// places; a coordinate that a node line leaves out is added where it is not 0 any more. The line that includes another
/// file stays where that file's nodes are where they were and the same file is found from the folder that is written
/// to; else the file's text takes its place. `points` are those that were read.
std::shared_ptr<const OriginalFile> make_inp_original(std::deque<InpSource> sources, std::vector<double> points);

}  // namespace trismooth
