// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"

/// Small files that are read in parts of any size.
namespace part_samples {

struct Sample {
  std::string name;
  const trismooth::Codec& codec;
  std::string bytes;
};

/// MSH of every version, text and binary, plain and with what is read one by one, and refused.
void add_msh_samples(std::vector<Sample>& all);

}  // namespace part_samples
