// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// The parts of a run's time in their order, each with its name in reports; the total is not among them.
inline std::array<std::pair<std::string_view, double>, 11> timing_parts(const PipelineTimings& timings) {
  return {{{"read", timings.read},
           {"topology", timings.topology},
           {"check_before", timings.check_before},
           {"transfer_in", timings.transfer_in},
           {"untangle", timings.untangle},
           {"smooth", timings.smooth},
           {"transfer_out", timings.transfer_out},
           {"commit", timings.guard},
           {"fields", timings.fields},
           {"check_after", timings.check_after},
           {"write", timings.write}}};
}

}  // namespace trismooth
