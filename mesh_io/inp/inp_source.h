// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/number_sites.h"

namespace trismooth {

/// A coordinate that a node line leaves out: it is 0.
struct InpGap {
  std::uint64_t offset = 0;  ///< where its text would stand
  std::int32_t vertex = 0;
  std::uint8_t component = 0;  ///< x, y or z
  bool needs_comma = false;    ///< before it
};

/// Another file that a file names: by *INCLUDE, or by the parameter INPUT of a keyword whose data it has.
struct InpInclude {
  std::size_t source = 0;      ///< the file
  std::filesystem::path name;  ///< as it is written there
  std::size_t cut_begin = 0;   ///< what goes where the file's text comes in: the line, or the parameter
  std::size_t cut_end = 0;
  std::size_t place = 0;      ///< where its text comes in, not before cut_end
  bool on_next_line = false;  ///< its text begins a line behind that place
};

/// One of the files that an input file consists of, at one place: a file that is included twice is two sources.
struct InpSource {
  std::filesystem::path path;
  FileBytes bytes;
  std::vector<NumberSites> sites;  ///< each with the nodes of one spelling, each behind the one before
  std::vector<InpGap> gaps;        ///< in the file's order
  std::vector<InpInclude> includes;
};

/// Which source each node, or element, is from: told in their order.
class InpOrigins {
 public:
  void add(std::size_t index, std::size_t source) {
    if (begins_.empty() || begins_.back().second != source) {
      begins_.emplace_back(index, source);
    }
  }
  std::size_t source_of(std::size_t index) const {
    const auto behind = std::upper_bound(
        begins_.begin(), begins_.end(), index,
        [](std::size_t wanted, const std::pair<std::size_t, std::size_t>& begin) { return wanted < begin.first; });
    return std::prev(behind)->second;
  }

 private:
  std::vector<std::pair<std::size_t, std::size_t>> begins_;
};

}  // namespace trismooth
