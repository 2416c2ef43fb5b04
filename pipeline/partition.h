// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "trismooth/base/enum_text.h"

namespace trismooth {

/// How a mesh is shared out among the ranks of an MPI job. No result depends on it.
enum class Partition : std::uint8_t {
  keep,    ///< as the files have it: blocks of pieces that follow each other; of one file, of vertices
  bisect,  ///< halved again and again, across the longer side of each half
  metis    ///< by METIS, where the build has it: blocks of vertices with few edges between ranks
};

template <>
struct EnumText<Partition> {
  static constexpr std::string_view what = "partition";
  static constexpr std::array<std::pair<Partition, std::string_view>, 3> texts{
      {{Partition::keep, "keep"}, {Partition::bisect, "bisect"}, {Partition::metis, "metis"}}};
};

}  // namespace trismooth
