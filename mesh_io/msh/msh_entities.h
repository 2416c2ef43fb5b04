// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/msh/msh_input.h"

namespace trismooth {

/// A point, curve, surface or volume of the geometry that the mesh was made of, as far as its elements need it.
struct MshEntity {
  std::int32_t geometrical = 0;          ///< its tag; of a part of a partitioned entity that of the whole
  std::int32_t partition = 0;            ///< the first one; 0: none
  std::vector<std::int32_t> physical{};  ///< tags of groups, no signs, the first one as listed, no two alike
};

/// The sections $Entities and $PartitionedEntities of versions 4.
class MshEntities {
 public:
  /// Reads what follows the section's first line, up to its end.
  void read(MshInput& input, bool partitioned);

  /// The entity; one of that tag and no groups where the file says nothing of it.
  const MshEntity& operator()(int dimension, std::int64_t tag);

 private:
  void read_one(MshInput& input, int dimension, bool partitioned);

  std::map<std::pair<int, std::int64_t>, MshEntity> entities_;
};

}  // namespace trismooth
