// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace trismooth {

namespace cuda {
struct DeviceSurvey;
}

/// The lines of `trismooth info` on CUDA: the versions of runtime and driver and whether CDP is built in, then each
/// device, and why there are no more. Each line ends in a line feed.
std::string cuda_lines(const cuda::DeviceSurvey& survey, bool has_cdp);

}  // namespace trismooth
