// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/ranges/number_range.h"

namespace trismooth {

/// The implied set of the nodes of curves of the geometry; that of points is points_of_geometry.
inline constexpr std::string_view curves_of_geometry = "gmsh:curves";

/// A binary MSH file that can be read by ranges: of version 2 or 4.1, with sections for names, entities, nodes and
/// elements alone, whose tags of nodes count on from first to last, as those of elements do.
class MshRanges {
 public:
  /// Reads what stands before the nodes and the heads of all blocks, of which there are few. Throws ReadError for other
  /// files, which may be as good.
  explicit MshRanges(const std::filesystem::path& path);
  MshRanges(const MshRanges&) = delete;
  MshRanges& operator=(const MshRanges&) = delete;
  ~MshRanges();

  std::uint64_t point_count() const;
  std::uint64_t cell_count() const;
  /// Whether elements may be listed again for another group: of version 2.
  bool may_repeat_elements() const;

  /// Reads the points and the cells of these numbers by the rules that the whole file is read by; corners are numbers
  /// of points in the whole file, and implied sets have those of the range, by the rules for the whole. An array of
  /// labels is there where any of these cells has one. Without an original. Throws ReadError where anything is wrong,
  /// or unusual; the message is not that of the whole file. Complexity: linear in what is read.
  MeshDocument read(NumberRange points, NumberRange cells, const FileWorkers& workers) const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace trismooth
