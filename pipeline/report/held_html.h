// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// What is held and why, as a part of a page: the vertices by reason, and every array and file that was obeyed with why
/// and how many vertices it holds.
std::string held_html(const InputSummary& input);

}  // namespace trismooth
