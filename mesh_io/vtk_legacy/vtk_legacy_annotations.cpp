// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_annotations.h"

#include <algorithm>

#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/text/blanks.h"

namespace trismooth {

namespace {

constexpr std::string_view white_space = " \t\v\f\r\n";

}  // namespace

/// METADATA takes the white space behind it along: what follows must not join what comes before.
ByteEdit VtkLegacyAnnotations::cut(std::size_t begin, std::size_t end) const {
  const bool joins = end < bytes_.size() && white_space.find(bytes_[end]) == std::string_view::npos;
  return {begin, end, joins ? "\n" : ""};
}

void VtkLegacyAnnotations::start_section(VtkLegacyLayout::Section section, std::size_t begin) {
  end_section(begin);
  section_ = section;
  section_begin_ = begin;
  edits_before_section_ = edits_.size();
  keeps_something_ = false;
}

void VtkLegacyAnnotations::add(const Attribute& attribute) {
  const auto are_ours = [](const ArraySite& array) { return is_annotation(array.name); };
  const auto ours = static_cast<std::size_t>(std::ranges::count_if(attribute.arrays, are_ours));
  const std::size_t all = std::max(attribute.arrays.size(), attribute.declared_arrays);
  if (ours > 0 && ours == all) {
    edits_.push_back(cut(attribute.begin, attribute.end));
    return;
  }
  keeps_something_ = true;
  if (ours > 0) {
    edits_.push_back({attribute.count_begin, attribute.count_end, std::to_string(all - ours)});
    for (const ArraySite& array : attribute.arrays) {
      if (are_ours(array)) {
        edits_.push_back(cut(array.begin, array.end));
      }
    }
  }
}

void VtkLegacyAnnotations::end_section(std::size_t end) {
  if (!keeps_something_ && edits_.size() > edits_before_section_) {
    edits_.resize(edits_before_section_);
    edits_.push_back(cut(section_begin_, end));
  } else {
    last_kept_ = section_;
  }
}

void VtkLegacyAnnotations::finish(VtkLegacyLayout& layout) {
  end_section(bytes_.find_last_not_of(white_space) + 1);
  layout.last_section = last_kept_;
  for (ByteEdit& edit : edits_) {
    const bool adjoins = !layout.without_annotations.empty() && layout.without_annotations.back().end == edit.begin;
    if (adjoins) {
      layout.without_annotations.back().end = edit.end;
      layout.without_annotations.back().text += edit.text;
    } else {
      layout.without_annotations.push_back(std::move(edit));
    }
  }
  if (layout.without_annotations.empty()) {
    return;
  }
  // What the file ended in, the white space behind it included, gives way but for the end of the line before it.
  ByteEdit& last = layout.without_annotations.back();
  if (bytes_.find_first_not_of(white_space, last.end) == std::string_view::npos) {
    last.end = bytes_.size();
    const std::size_t line_end = std::min(bytes_.find_first_not_of(blanks, last.begin), bytes_.size());
    const std::string_view taken = bytes_.substr(line_end);
    const std::size_t length = taken.starts_with("\r\n") ? 2 : taken.starts_with('\n') ? 1 : 0;
    const bool at_line_start = bytes_[last.begin - 1] == '\n';  // METADATA took the end of its last line
    last.begin = length > 0 && !at_line_start ? line_end + length : last.begin;
  }
}

std::string edited(std::string_view bytes, std::size_t begin, std::span<const ByteEdit> edits) {
  std::string text;
  for (const ByteEdit& edit : edits) {
    text.append(bytes.substr(begin, edit.begin - begin)).append(edit.text);
    begin = edit.end;
  }
  return text.append(bytes.substr(begin));
}

}  // namespace trismooth
