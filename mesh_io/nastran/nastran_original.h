// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/nastran/nastran_source.h"

namespace trismooth {

/// Of a coordinate: those of a large field.
inline constexpr std::size_t most_nastran_characters = 16;

/// The original of a deck. The first of the sources is written byte by byte, with new coordinates in their places. A
/// GRID in small field whose new numbers do not fit there becomes one in large field, on two lines. The statement that
/// includes another file stays where that file's nodes are where they were and the same file is found from the folder
/// that is written to; else the file's text takes its place. `points` are those that were read.
std::shared_ptr<const OriginalFile> make_nastran_original(std::deque<NastranSource> sources,
                                                          std::vector<double> points);

}  // namespace trismooth
