// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/run_state.h"

namespace trismooth {

void RunState::enter_frame() {
  local = local_points(
      mesh.points, [this](std::size_t v) { return mesh.in_cell[v] != 0; }, workers);
}

}  // namespace trismooth
