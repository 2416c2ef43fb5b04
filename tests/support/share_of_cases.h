// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>

/// A whole number in the environment.
inline std::int64_t from_environment(const char* name, std::int64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoll(text, nullptr, 10);
}

/// Of very many cases so many per cent are enough from day to day: TRISMOOTH_MESHES in the environment; else all.
inline std::int64_t per_cent_of_cases() {
  return from_environment("TRISMOOTH_MESHES", 100);
}
