// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

#include "support/accepted_files.h"

/// The part of accepted_files.h that is VTK's formats.
namespace accepted_files::vtk {

/// The bytes of a number.
template <class T>
std::string number_bytes(T number, bool big_endian) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(number);
  if (big_endian != (std::endian::native == std::endian::big)) {
    std::ranges::reverse(bytes);
  }
  return {bytes.data(), bytes.size()};
}

}  // namespace accepted_files::vtk
