// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_layout.h"

namespace trismooth {

/// Follows a reader through the point and cell data of a legacy VTK file and finds the edits after which the file holds
/// no annotation of an earlier run (see annotation_names.h) and is else as it was: whole attributes, arrays within a
/// FIELD with the number that it declares, and sections that held nothing else. Positions are byte offsets: what the
/// reader stands at before the white space in front of a thing, and behind the thing.
class VtkLegacyAnnotations {
 public:
  explicit VtkLegacyAnnotations(std::string_view bytes) : bytes_(bytes) {}

  /// A POINT_DATA or CELL_DATA begins.
  void start_section(VtkLegacyLayout::Section section, std::size_t begin);
  /// An attribute of the section was read: its arrays, and of a FIELD the place of the number of them.
  struct ArraySite {
    std::string name;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  struct Attribute {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::vector<ArraySite> arrays;
    std::size_t declared_arrays = 0;  ///< in a FIELD; 0 elsewhere
    std::size_t count_begin = 0;      ///< the place of that number
    std::size_t count_end = 0;
  };
  void add(const Attribute& attribute);
  /// The end of the file. Fills the layout's `last_section` and `without_annotations`.
  void finish(VtkLegacyLayout& layout);

 private:
  void end_section(std::size_t end);
  ByteEdit cut(std::size_t begin, std::size_t end) const;

  std::string_view bytes_;
  std::vector<ByteEdit> edits_;
  VtkLegacyLayout::Section section_ = VtkLegacyLayout::Section::geometry;
  VtkLegacyLayout::Section last_kept_ = VtkLegacyLayout::Section::geometry;
  std::size_t section_begin_ = 0;
  std::size_t edits_before_section_ = 0;
  bool keeps_something_ = false;  ///< the section holds something that is no annotation, or nothing at all
};

/// What the edits, which stand in their order and do not overlap, leave of the bytes from `begin` on.
std::string edited(std::string_view bytes, std::size_t begin, std::span<const ByteEdit> edits);

}  // namespace trismooth
