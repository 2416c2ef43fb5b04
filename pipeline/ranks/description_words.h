// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// What is said of an array, which may be nothing (null), as words for other ranks. Local.
std::vector<std::string> words_of(const ArrayDescription* description);

/// The description back from its words, which begin at `word`; that is behind them afterwards. Local.
std::shared_ptr<const ArrayDescription> description_of(std::vector<std::string>::const_iterator& word);

}  // namespace trismooth
