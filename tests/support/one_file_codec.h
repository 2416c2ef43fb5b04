// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "trismooth/mesh_io/codec.h"

namespace test_support {

/// codec_of(format) for files that are one: the two of a mesh of Triangle stand in one text, joined_files(). Its
/// documents are written back, and from scratch, to such a text too.
const trismooth::Codec& one_file_codec(trismooth::FileFormat format);

/// The nodes, ASCII's separator of files, and the elements.
std::string joined_files(std::string_view nodes, std::string_view elements);

}  // namespace test_support
