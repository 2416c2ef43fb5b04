// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>

#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// Who reads or writes a file, and in what parts it is shared out. What is read and written is the same for every
/// number of threads and every size of the parts.
struct FileWorkers {
  /// Parts that are worth sharing out; with one thread the whole file is one part.
  explicit FileWorkers(Workers& all) : FileWorkers(all, all.count() == 1 ? whole : default_part_bytes) {}
  /// Parts of that many bytes, also with one thread: for tests. `serial`: every number by the careful way that serves
  /// where anything is unusual.
  FileWorkers(Workers& all, std::size_t part) : workers(all), part_bytes(part) {}

  static constexpr std::size_t serial = 0;
  static constexpr std::size_t whole = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t default_part_bytes = std::size_t{1} << 18;

  Workers& workers;
  std::size_t part_bytes;
};

}  // namespace trismooth
