// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

/// The first line end (LF or CR) of text[begin, end of text), or the end of the text.
std::size_t find_line_end(std::string_view text, std::size_t begin);

/// A text cut at ends of lines into parts of about the workers' part_bytes. CR LF may be cut in two: it is a line end
/// and an empty line behind it then. The text must outlive the object.
class LineParts {
 public:
  /// Of text[begin, end of text). One pass over what stands at the cuts.
  LineParts(std::string_view text, std::size_t begin, const FileWorkers& workers);

  std::size_t size() const { return begins_.size() - 1; }
  /// Byte offsets where a part begins, at the begin of a line, and behind its last line end.
  std::size_t begin(std::size_t part) const { return begins_[part]; }
  std::size_t end(std::size_t part) const { return begins_[part + 1]; }

  /// Calls body(part) for every part, in any order, on any worker. True where it was true for all of them; some may be
  /// left out where it was not.
  template <class Body>
  bool all_of(const Body& body) const {
    std::atomic<bool> all = true;
    workers_.for_blocks(static_cast<std::int64_t>(size()), 1, [&](std::int64_t first, std::int64_t last) {
      for (auto part = static_cast<std::size_t>(first); part < static_cast<std::size_t>(last) && all; ++part) {
        if (!body(part)) {
          all = false;
        }
      }
    });
    return all;
  }

 private:
  Workers& workers_;
  std::vector<std::size_t> begins_;  ///< of the parts, and the end of the text
};

}  // namespace trismooth
