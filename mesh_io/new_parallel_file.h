// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"

namespace trismooth {

/// A parallel file that was not read.
struct NewParallelFile {
  std::string bytes;
  ParallelFile file;  ///< what these say
};

/// The parallel file of pieces of that format, vtu or vtp, which have the points and arrays of `document`, whose values
/// do not matter.
NewParallelFile make_parallel_file(FileFormat piece_format, const MeshDocument& document,
                                   std::span<const std::string> sources);

/// The text of a parallel file that lists these arrays as well, whose values do not matter.
std::string with_arrays(std::string text, const AddedArrays& added);

}  // namespace trismooth
