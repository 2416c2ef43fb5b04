// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/share_reading.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/input_file.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/ranks/document_layout.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

namespace {

/// The format that a file is of by its name and by its first bytes, where it is read by ranges.
std::optional<FileFormat> range_format_of(const std::filesystem::path& path) {
  constexpr std::size_t head_bytes = std::size_t{1} << 16;
  const std::optional<FileFormat> format = format_of(path);
  // (What is no file on a disk can be read once.)
  if (is_standard_stream(path) || !std::filesystem::is_regular_file(path) ||
      !(format == FileFormat::off || format == FileFormat::vtu || format == FileFormat::msh)) {
    return std::nullopt;
  }
  const InputFile file(path);
  const FileBytes head = file.read_range(0, head_bytes);
  return file.size() > 0 && codec_of(*format).recognises(head) ? format : std::nullopt;
}

/// Whether all ranks that have any rows have the same arrays.
bool has_one_layout(const MeshDocument& document, const mpi::Communicator& ranks) {
  const auto is_same = [&](bool has_rows, const std::vector<char>& layout) {
    const std::vector<char> own = has_rows ? layout : std::vector<char>{};
    const std::vector<char> first = first_bytes(own, ranks);
    return !ranks.any(has_rows && own != first);
  };
  const bool of_points = is_same(!document.points.empty(), packed_point_layout(document));
  return is_same(document.cells.size() > 0, packed_cell_layout(document)) && of_points;
}

}  // namespace

std::optional<MeshShare> read_share(const std::filesystem::path& path, const mpi::Communicator& ranks,
                                    Workers& workers) {
  std::optional<FileFormat> format;
  const bool is_known = works_on_all(ranks, [&] {
    format = range_format_of(path);
    return format.has_value();
  });
  if (!is_known) {
    return std::nullopt;
  }
  std::optional<MeshShare> share = format == FileFormat::off   ? read_off_share(path, ranks, workers)
                                   : format == FileFormat::vtu ? read_vtu_share(path, ranks, workers)
                                                               : read_msh_share(path, ranks, workers);
  if (!share || !has_one_layout(share->document, ranks)) {
    return std::nullopt;
  }
  share->document.format = *format;
  return share;
}

}  // namespace trismooth
