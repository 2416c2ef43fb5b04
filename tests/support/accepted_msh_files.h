// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "support/accepted_files.h"

/// The part of accepted_files.h that is the format of Gmsh.
namespace accepted_files::msh {

/// How a file spells the mesh.
struct Spelling {
  int version = 41;  ///< ten times the version: 10, 20, 21, 22, 40, 41
  bool binary = false;
  bool big_endian = false;
  int size_bytes = 8;  ///< of a count, in binary files of version 4.1
  bool parametric = false;
  bool partitioned = false;
  bool with_groups = false;  ///< names, and entities in two groups
  bool with_data = false;
  bool sparse = false;  ///< tags far apart, in no order
  std::string head{};   ///< in front of all
  std::string tail{};   ///< behind the last section
};

std::string file(const Spelling& spelling);

}  // namespace accepted_files::msh
