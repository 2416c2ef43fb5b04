// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Whether a text has these words somewhere.
inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}
