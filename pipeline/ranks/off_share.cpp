// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trismooth/mesh_io/bytes/input_file.h"
#include "trismooth/mesh_io/off/off_header.h"
#include "trismooth/mesh_io/off/off_reader.h"
#include "trismooth/mesh_io/ranges/line_ranges.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/pipeline/ranks/share_reading.h"

namespace trismooth {

std::optional<MeshShare> read_off_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                        Workers& workers) {
  constexpr std::size_t head_bytes = std::size_t{1} << 16;
  const FileWorkers file_workers(workers);
  FileBytes head;
  OffHeader header;
  FileBytes lines;
  std::int64_t rows = 0;
  const bool has_lines = works_on_all(ranks, [&] {
    const InputFile file(path);
    const std::size_t size = file.size();
    head = file.read_range(0, std::min(size, head_bytes));
    const std::string_view text = head.view();
    TextScanner scanner(text, path, TextScanner::Comments::hash,
                        text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    header = read_off_header(scanner, size);
    const std::size_t begin = scanner.offset();
    if (header.is_binary || begin == text.size()) {
      return false;
    }
    const auto [first, last] = range_of_rank(size - begin, ranks);
    const auto line_at = [&](std::size_t offset) { return offset == begin ? begin : line_begin_from(file, offset); };
    lines = file.read_range(line_at(begin + first), line_at(begin + last));
    rows = static_cast<std::int64_t>(count_lines_with_tokens(lines, file_workers));
    return true;
  });
  if (!has_lines) {
    return std::nullopt;
  }
  const auto vertices = static_cast<std::int64_t>(header.vertex_count);
  const std::int64_t before = ranks.sum_before(rows);
  if (ranks.sum(rows) != vertices + static_cast<std::int64_t>(header.face_count)) {
    return std::nullopt;
  }
  MeshShare share;
  const bool is_read = works_on_all(ranks, [&] {
    const std::int64_t own_vertices = std::clamp(vertices - before, std::int64_t{0}, rows);
    share.document = read_off_rows(path, lines, header, static_cast<std::size_t>(own_vertices),
                                   static_cast<std::size_t>(rows - own_vertices), file_workers);
    return true;
  });
  return is_read ? std::optional(std::move(share)) : std::nullopt;
}

}  // namespace trismooth
