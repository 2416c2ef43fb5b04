// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trismooth/mesh_io/file_format.h"

/// Small files of every dialect of every format that is read, all of one mesh: what tests damage, and what fuzzers
/// start from.
namespace accepted_files {

struct AcceptedFile {
  std::string name;
  std::string extension;  ///< with its dot
  std::string bytes;
  double scale = 1;  ///< of the mesh: 4 in files whose coordinates are whole numbers
};

/// What the file is: the format that its name begins with ("off_colours"), or, where its extension is not of that
/// format, the first that the extension names.
trismooth::FileFormat format_of(const AcceptedFile& file);

/// Whether it is a file as it is. Where not, it is the two of one mesh in one text: see one_file_codec.h.
bool is_one_file(const AcceptedFile& file);

/// Every file; no two have the same name. Made once.
const std::vector<AcceptedFile>& all();

/// Four triangles around a point of a square, and, in files that hold `others`, a quadrilateral and a pentagon beside
/// them. All coordinates are exact in float32.
struct Mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>> faces;
};
Mesh mesh(bool others);

/// "0.75 1.25 0".
std::string text_of(const std::array<double, 3>& point);

}  // namespace accepted_files
