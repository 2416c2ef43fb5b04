#include "trismooth/pipeline/stages/run_state.h"

#include <utility>

namespace trismooth {

void RunState::enter_frame() {
  local = local_points(
      mesh.points, [this](std::size_t v) { return mesh.in_cell[v] != 0; }, workers);
}

void RunState::warn(std::string warning) {
  result.warnings.push_back(std::move(warning));
  if (options.warned) {
    options.warned(result.warnings.back());
  }
}

}  // namespace trismooth
